//! Coefficients of models of the ionosphere, of headers (RINEX 2.11, table A3; RINEX 3.05, table A5, `IONOSPHERIC CORR`) and of
//! messages (RINEX 4.02, tables of `ION` records).

use insd_base::{Constellation, IonosphereModel};

use crate::decimal::scientific;
use crate::error::Flaw;
use crate::navigation::entry::Entry;
use crate::text::{columns, push_header};

/// Names of the lines for the amplitude and for the period.
const KLOBUCHAR: [(Constellation, &str, &str); 4] = [
    (Constellation::Gps, "GPSA", "GPSB"),
    (Constellation::BeiDou, "BDSA", "BDSB"),
    (Constellation::Qzss, "QZSA", "QZSB"),
    (Constellation::Navic, "IRNA", "IRNB"),
];

const LABEL: &str = "IONOSPHERIC CORR";

/// The models of a file, and halves of them whose other line is still to come.
#[derive(Clone, Debug, Default)]
pub(crate) struct Models {
    whole: Vec<(Constellation, IonosphereModel)>,
    halves: Vec<(Constellation, bool, [f64; 4])>,
}

impl Models {
    /// Takes a line of a header of version 3.
    pub(crate) fn line(&mut self, line: &[u8], number: usize) -> Result<(), Flaw> {
        let name = columns(line, 0, 4).trim_ascii();
        let Some(numbers) = numbers(line, 5) else {
            return Err(Flaw::new(number, LABEL, "numbers D12.4", line));
        };
        if name == b"GAL" {
            let [a0, a1, a2, _] = numbers;
            self.add(
                Constellation::Galileo,
                IonosphereModel::NeQuickG { ionisation: [a0, a1, a2] },
            );
        }
        for (own, alpha, beta) in KLOBUCHAR {
            if name == alpha.as_bytes() || name == beta.as_bytes() {
                self.half(own, name == alpha.as_bytes(), numbers);
            }
        }
        Ok(())
    }

    /// Takes `ION ALPHA` or `ION BETA` of version 2.
    pub(crate) fn early(&mut self, line: &[u8], is_alpha: bool, number: usize) -> Result<(), Flaw> {
        let numbers = numbers(line, 2);
        let numbers = numbers.ok_or_else(|| Flaw::new(number, "ION", "numbers D12.4", line))?;
        self.half(Constellation::Gps, is_alpha, numbers);
        Ok(())
    }

    fn half(&mut self, own: Constellation, is_alpha: bool, numbers: [f64; 4]) {
        self.halves.retain(|(other, alpha, _)| (*other, *alpha) != (own, is_alpha));
        self.halves.push((own, is_alpha, numbers));
        let find = |wanted| {
            let found =
                self.halves.iter().find(|(other, alpha, _)| (*other, *alpha) == (own, wanted));
            found.map(|(_, _, numbers)| *numbers)
        };
        if let (Some(alpha), Some(beta)) = (find(true), find(false)) {
            self.add(own, IonosphereModel::Klobuchar { alpha, beta });
        }
    }

    /// Keeps the newest model of a constellation; one of zeros is how writers say that they have none.
    fn add(&mut self, own: Constellation, model: IonosphereModel) {
        let is_empty = match &model {
            IonosphereModel::Klobuchar { alpha, beta } => {
                alpha.iter().chain(beta).all(|c| *c == 0.0)
            }
            IonosphereModel::NeQuickG { ionisation } => ionisation.iter().all(|c| *c == 0.0),
        };
        if !is_empty {
            self.whole.retain(|(other, _)| *other != own);
            self.whole.push((own, model));
        }
    }

    /// Takes a message of version 4; false where it is of another model (BDGIM).
    pub(crate) fn message(&mut self, entry: &Entry<'_>) -> Result<bool, Flaw> {
        let own = entry.satellite.constellation;
        let number = |index| entry.required(index, "ION", 0);
        match (own, entry.message) {
            (Constellation::Galileo, _) => {
                let ionisation = [number(0)?, number(1)?, number(2)?];
                self.add(own, IonosphereModel::NeQuickG { ionisation });
            }
            (Constellation::BeiDou, b"D1D2") | (_, b"LNAV") | (Constellation::Qzss, _) => {
                let alpha = [number(0)?, number(1)?, number(2)?, number(3)?];
                let beta = [number(4)?, number(5)?, number(6)?, number(7)?];
                self.add(own, IonosphereModel::Klobuchar { alpha, beta });
            }
            _ => return Ok(false),
        }
        Ok(true)
    }

    pub(crate) fn into_whole(self) -> Vec<(Constellation, IonosphereModel)> {
        self.whole
    }
}

/// Four numbers D12.4; a blank last one is zero, as Galileo has three.
fn numbers(line: &[u8], from: usize) -> Option<[f64; 4]> {
    let mut numbers = [0.0; 4];
    for (index, number) in numbers.iter_mut().enumerate() {
        let from = from + 12 * index;
        let told = scientific(columns(line, from, from + 12), 0).ok()?;
        *number = if index == 3 { told.unwrap_or(0.0) } else { told? };
    }
    Some(numbers)
}

/// Writes the lines of a model; those that version 3 has no line for are left out.
pub(crate) fn push(out: &mut String, own: Constellation, model: &IonosphereModel) {
    match model {
        IonosphereModel::NeQuickG { ionisation: [a0, a1, a2] } => {
            push_line(out, "GAL", [*a0, *a1, *a2, 0.0]);
        }
        IonosphereModel::Klobuchar { alpha, beta } => {
            let names = KLOBUCHAR.iter().find(|(other, _, _)| *other == own);
            if let Some((_, first, second)) = names {
                push_line(out, first, *alpha);
                push_line(out, second, *beta);
            }
        }
    }
}

fn push_line(out: &mut String, name: &str, numbers: [f64; 4]) {
    let numbers = numbers.map(|number| {
        let text = format!("{number:.4e}");
        let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
        format!("{:>12}", format!("{mantissa}E{:+03}", exponent.parse::<i32>().unwrap_or(0)))
    });
    push_header(out, &format!("{name:<5}{}", numbers.concat()), LABEL);
}
