//! Prints what this crate reads in each sentence of all files below a folder, one JSON object on a
//! line: file, offset of the line's end, the sentence, and its fields in SI units, or the fault, or what kind of other sentence it is. For the
//! comparison with other decoders in `tests/conformance/nmea.py`.

use std::error::Error;
use std::fs;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use insd_wire::nmea::{
    Date, FixDimension, Frame, Gga, Gns, Gsa, Gsv, HeadingMode, NmeaFault, NortekBottomTrack,
    Pashr, Position, PositionMode, Psxn, PsxnQuality, Rmc, Sentence, TimeOfDay, Vbw, Zda, others,
};
use insd_wire::stream::{Cutter, Protocol};
use serde_json::{Map, Value, json};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = std::env::args().nth(1).ok_or("which folder?")?;
    let mut out = BufWriter::new(std::io::stdout().lock());
    for path in files(Path::new(&folder))? {
        let mut cutter = Cutter::new(&[Protocol::Nmea]);
        cutter.push(&fs::read(&path)?);
        while let Some(cut) = cutter.cut() {
            let Ok(frame) = Frame::parse(cut.bytes) else { continue };
            let mut object = match Sentence::read_frame(&frame) {
                Ok(sentence) => json!({ "fields": fields(&sentence) }),
                Err(NmeaFault::OtherSentence | NmeaFault::Address) => json!({
                    "other": others::kind(cut.bytes).map(|kind| format!("{:?}", kind.understood))?,
                }),
                Err(fault) => json!({ "fault": fault.to_string() }),
            };
            object["file"] = json!(path.strip_prefix(&folder)?.display().to_string());
            object["end"] = json!(cut.end);
            object["line"] = json!(String::from_utf8_lossy(cut.bytes));
            writeln!(out, "{object}")?;
        }
    }
    Ok(())
}

/// All files below a folder, in a fixed order.
fn files(folder: &Path) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() { found.extend(files(&path)?) } else { found.push(path) }
    }
    found.sort();
    Ok(found)
}

fn fields(sentence: &Sentence) -> Value {
    match sentence {
        Sentence::Gga(gga) => of_gga(gga),
        Sentence::Gns(gns) => of_gns(gns),
        Sentence::Rmc(rmc) => of_rmc(rmc),
        Sentence::Gsa(gsa) => of_gsa(gsa),
        Sentence::Gsv(gsv) => of_gsv(gsv),
        Sentence::Zda(zda) => of_zda(zda),
        Sentence::Vbw(vbw) => of_vbw(vbw),
        Sentence::Pashr(pashr) => of_pashr(pashr),
        Sentence::Gll(gll) => merged(
            position(gll.position),
            json!({ "time": time(gll.time), "valid": gll.valid, "mode": mode(gll.mode) }),
        ),
        Sentence::Gst(gst) => json!({
            "time": time(gst.time), "range_rms": gst.range_rms, "major_std": gst.major_std,
            "minor_std": gst.minor_std, "orientation": gst.orientation,
            "latitude_std": gst.latitude_std, "longitude_std": gst.longitude_std,
            "altitude_std": gst.altitude_std,
        }),
        Sentence::Dtm(dtm) => json!({
            "datum": dtm.datum.map(|datum| datum.as_str().to_owned()),
            "subdivision": dtm.subdivision.map(char::from),
            "latitude_offset": dtm.latitude_offset, "longitude_offset": dtm.longitude_offset,
            "altitude_offset": dtm.altitude_offset,
            "reference": dtm.reference.map(|datum| datum.as_str().to_owned()),
        }),
        Sentence::Hdg(hdg) => json!({
            "reading": hdg.reading, "deviation": hdg.deviation, "variation": hdg.variation,
        }),
        Sentence::Hdm(hdm) => json!({ "heading": hdm.heading }),
        Sentence::Hdt(hdt) => json!({ "heading": hdt.heading }),
        Sentence::Ths(ths) => json!({
            "heading": ths.heading, "mode": char::from(HeadingMode::letter(ths.mode)),
        }),
        Sentence::Rot(rot) => json!({ "rate": rot.rate, "valid": rot.valid }),
        Sentence::Vhw(vhw) => json!({
            "heading": vhw.heading, "heading_magnetic": vhw.heading_magnetic, "speed": vhw.speed,
        }),
        Sentence::Vlw(vlw) => json!({
            "water": vlw.water, "water_trip": vlw.water_trip,
            "ground": vlw.ground, "ground_trip": vlw.ground_trip,
        }),
        Sentence::Vtg(vtg) => json!({
            "course": vtg.course, "course_magnetic": vtg.course_magnetic, "speed": vtg.speed,
            "mode": mode(vtg.mode),
        }),
        Sentence::Vdr(vdr) => json!({
            "set": vdr.set, "set_magnetic": vdr.set_magnetic, "drift": vdr.drift,
        }),
        Sentence::NortekBottomTrack(track) => of_nortek(track),
        Sentence::Psxn(psxn) => of_psxn(psxn),
        other => json!({ "debug": format!("{other:?}") }),
    }
}

fn of_gga(gga: &Gga) -> Value {
    merged(
        position(gga.position),
        json!({
            "time": time(gga.time), "quality": gga.quality.as_gga(), "satellites": gga.satellites,
            "hdop": gga.hdop, "altitude": gga.altitude, "geoid_separation": gga.geoid_separation,
            "age": gga.age, "station": gga.station,
        }),
    )
}

fn of_gns(gns: &Gns) -> Value {
    let modes: String = gns.modes.iter().flatten().map(|m| char::from(m.letter())).collect();
    merged(
        position(gns.position),
        json!({
            "time": time(gns.time), "modes": modes, "satellites": gns.satellites,
            "hdop": gns.hdop, "altitude": gns.altitude, "geoid_separation": gns.geoid_separation,
            "age": gns.age, "station": gns.station,
            "nav_status": gns.nav_status.map(|status| char::from(status.letter())),
        }),
    )
}

fn of_rmc(rmc: &Rmc) -> Value {
    merged(
        position(rmc.position),
        json!({
            "time": time(rmc.time), "valid": rmc.valid, "speed": rmc.speed, "course": rmc.course,
            "date": date(rmc.date), "variation": rmc.variation, "mode": mode(rmc.mode),
            "nav_status": rmc.nav_status.map(|status| char::from(status.letter())),
        }),
    )
}

fn of_gsa(gsa: &Gsa) -> Value {
    let dimension = match gsa.dimension {
        FixDimension::None => 1,
        FixDimension::Two => 2,
        FixDimension::Three => 3,
    };
    json!({
        "automatic": gsa.automatic, "dimension": dimension, "satellites": gsa.satellites,
        "pdop": gsa.pdop, "hdop": gsa.hdop, "vdop": gsa.vdop, "system": gsa.system,
    })
}

fn of_gsv(gsv: &Gsv) -> Value {
    let satellites: Vec<Value> = gsv
        .satellites
        .iter()
        .map_while(|satellite| *satellite)
        .map(|s| json!([s.id, s.elevation, s.azimuth, s.noise_density]))
        .collect();
    json!({
        "sentences": gsv.sentences, "number": gsv.number, "in_view": gsv.in_view,
        "satellites": satellites, "signal": gsv.signal,
    })
}

fn of_zda(zda: &Zda) -> Value {
    json!({
        "time": time(zda.utc.map(|utc| utc.time)), "date": date(zda.utc.map(|utc| utc.date)),
        "zone_hours": zda.zone.map(|zone| zone.hours),
        "zone_minutes": zda.zone.map(|zone| zone.minutes),
    })
}

fn of_vbw(vbw: &Vbw) -> Value {
    json!({
        "water": [vbw.water.longitudinal, vbw.water.transverse], "water_valid": vbw.water.valid,
        "ground": [vbw.ground.longitudinal, vbw.ground.transverse],
        "ground_valid": vbw.ground.valid, "stern_water": vbw.stern_water.transverse,
        "stern_water_valid": vbw.stern_water.valid, "stern_ground": vbw.stern_ground.transverse,
        "stern_ground_valid": vbw.stern_ground.valid,
    })
}

fn of_pashr(pashr: &Pashr) -> Value {
    json!({
        "time": time(pashr.time), "heading": pashr.heading, "roll": pashr.roll,
        "pitch": pashr.pitch, "heave_as_sent": pashr.heave_as_sent, "roll_std": pashr.roll_std,
        "pitch_std": pashr.pitch_std, "heading_std": pashr.heading_std,
        "quality_digit": pashr.quality_digit, "status_digit": pashr.status_digit,
    })
}

fn of_psxn(psxn: &Psxn) -> Value {
    match psxn {
        Psxn::Motion { roll, pitch, heading, heave } => {
            json!({ "roll": roll, "pitch": pitch, "heading": heading, "heave": heave })
        }
        Psxn::Quality { horizontal, height, heading, attitude } => {
            let digit = |quality: &Option<PsxnQuality>| quality.map(|quality| quality as u8);
            let qualities = [horizontal, height, heading, attitude].map(digit);
            json!({ "qualities": qualities })
        }
        other => json!({ "debug": format!("{other:?}") }),
    }
}

fn of_nortek(track: &NortekBottomTrack) -> Value {
    let sensors = track.sensors.map(|s| {
        json!([s.voltage, s.sound_speed, s.pressure, s.temperature, s.status.map(f64::from)])
    });
    json!({
        "trigger_to_echo": track.trigger_to_echo, "echo_to_output": track.echo_to_output,
        "velocity": track.velocity, "figure_of_merit": track.figure_of_merit,
        "distances": track.distances, "sensors": sensors,
    })
}

fn position(position: Option<Position>) -> Value {
    json!({
        "latitude": position.map(|position| position.latitude),
        "longitude": position.map(|position| position.longitude),
    })
}

fn merged(first: Value, second: Value) -> Value {
    let mut all = Map::new();
    for value in [first, second] {
        if let Value::Object(map) = value {
            all.extend(map);
        }
    }
    Value::Object(all)
}

/// Nanoseconds of the day.
fn time(time: Option<TimeOfDay>) -> Option<i64> {
    time.map(TimeOfDay::as_nanos)
}

fn date(date: Option<Date>) -> Option<String> {
    date.map(|date| format!("{:04}-{:02}-{:02}", date.year, date.month, date.day))
}

fn mode(mode: Option<PositionMode>) -> Option<char> {
    mode.map(|mode| char::from(mode.letter()))
}
