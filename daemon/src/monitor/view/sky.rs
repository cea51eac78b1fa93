//! The satellites: first those that are not used, each with its reason, then the others side by side.

use insd_lab::style::{alarm, dim, panel};
use insd_web::snapshot::{SatelliteFate, ShownSatellite, SkyState, Snapshot};
use ratatui::Frame;
use ratatui::layout::Rect;
use ratatui::style::{Color, Style};
use ratatui::text::{Line, Span, Text};
use ratatui::widgets::{Paragraph, Wrap};

use super::super::text::{fixed, satellites as tally, span};

/// Width of one that is used, columns.
const WIDE: usize = 25;
/// Above the columns.
const HEAD: &str = "        el   az  dB Hz";
const MARKS: &str =
    " ● used  ◐ code only  △ not used yet, or not needed  ○ not usable  ✕ left out ";

/// All of them, as far as there is room.
pub(super) fn satellites(frame: &mut Frame<'_>, area: Rect, snapshot: &Snapshot) {
    let sky = &snapshot.sky;
    let block = panel("Satellites", Line::from(format!(" {} ", tally(sky)))).title_bottom(MARKS);
    let inner = block.inner(area);
    if sky.state != SkyState::Raw || sky.satellites.is_empty() {
        let text = Paragraph::new(format!(" {}", why_none(sky.state))).wrap(Wrap { trim: false });
        return frame.render_widget(text.block(block), area);
    }
    let (used, unused): (Vec<_>, Vec<_>) =
        sky.satellites.iter().partition(|own| own.fate == SatelliteFate::Used);
    let abreast = (usize::from(inner.width) / WIDE).max(1);
    let mut lines = vec![Line::styled(HEAD, dim())];
    let mut unused = unused;
    unused.sort_by_key(|own| rank(own.fate));
    lines.extend(unused.iter().map(|own| Line::from(vec![short(own), told(own, inner.width)])));
    lines.extend(used.chunks(abreast).map(|row| row.iter().map(|own| short(own)).collect()));
    let room = usize::from(inner.height);
    if lines.len() > room {
        let shown = room.saturating_sub(1);
        let seen = if shown > unused.len() { (shown - 1 - unused.len()) * abreast } else { 0 };
        let more = used.len().saturating_sub(seen) + (1 + unused.len()).saturating_sub(shown);
        lines.truncate(shown);
        lines.push(Line::styled(format!(" and {more} more: make the window larger"), alarm()));
    }
    frame.render_widget(Paragraph::new(Text::from(lines)).block(block), area);
}

fn why_none(state: SkyState) -> &'static str {
    match state {
        SkyState::Raw => "The receiver hears no satellite.",
        SkyState::FixesOnly => {
            "The receiver sends fixes only: nothing is known of single satellites."
        }
        SkyState::Silent => "What the receiver measures of each satellite is not told any more.",
        SkyState::NoReceiver => "No satellite receiver is heard.",
        SkyState::Unknown => "Nothing is known of the satellites.",
    }
}

/// Those that matter most come first.
fn rank(fate: SatelliteFate) -> u8 {
    match fate {
        SatelliteFate::LeftOut => 0,
        SatelliteFate::Refused => 1,
        SatelliteFate::Crowded | SatelliteFate::Waiting | SatelliteFate::Unknown => 2,
        SatelliteFate::CodeOnly | SatelliteFate::Used => 3,
    }
}

/// Mark, name, elevation, azimuth and strength, [`WIDE`] columns.
fn short(own: &ShownSatellite) -> Span<'static> {
    let (mark, style) = match own.fate {
        SatelliteFate::Used => ('●', Style::new().fg(Color::Green)),
        SatelliteFate::CodeOnly => ('◐', Style::new().fg(Color::Cyan)),
        SatelliteFate::LeftOut => ('✕', alarm()),
        SatelliteFate::Refused => ('○', dim()),
        SatelliteFate::Crowded | SatelliteFate::Waiting | SatelliteFate::Unknown => ('△', dim()),
    };
    let (elevation, azimuth) = (fixed(own.elevation_deg, 0), fixed(own.azimuth_deg, 0));
    let strongest = fixed(own.strongest(), 0);
    let text = format!(" {mark} {:<4}{elevation:>3} {azimuth:>4} {strongest:>6}", own.name);
    Span::styled(format!("{text:<WIDE$}"), style)
}

/// Why it is not used, or not wholly, in what is left of a row.
fn told(own: &ShownSatellite, width: u16) -> Span<'static> {
    let time = own.left_out_for_s.map(|time| format!("out {}: ", span(time))).unwrap_or_default();
    let style = if own.fate == SatelliteFate::LeftOut { alarm() } else { Style::new() };
    let text = format!("{time}{}", own.text.as_deref().unwrap_or_default());
    let room = usize::from(width).saturating_sub(WIDE);
    if text.chars().count() <= room {
        return Span::styled(text, style);
    }
    let kept: String = text.chars().take(room.saturating_sub(1)).collect();
    Span::styled(kept + "…", style)
}
