//! One bad field does not kill a sentence: it is unknown, and it is noted. The lines without a comment
//! are of public logs: the tests of gpsd, and the R/V Nathaniel B. Palmer of August 2014 (OpenRVDAS).

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

use insd_base::units::KNOT;
use insd_wire::nmea::{
    ChecksumPolicy, CivilTime, Date, Frame, Gga, Gll, Gsa, Gst, Hdg, LeftOut, NmeaFault, Rmc,
    Sentence, TimeOfDay, Vbw, Vtg, Zda, checksum,
};

/// Reads a sentence with its checksum, and what was left out of it.
fn read(line: &str) -> (Sentence, LeftOut) {
    let frame = Frame::parse(line.as_bytes()).unwrap();
    let sentence = Sentence::read_frame(&frame).unwrap_or_else(|fault| panic!("{line}: {fault}"));
    (sentence, frame.left_out())
}

/// The same with the checksum that belongs to it.
fn framed(text: &str) -> Result<(Sentence, LeftOut), NmeaFault> {
    let line = format!("{text}*{:02X}", checksum(&text.as_bytes()[1..]));
    let frame = Frame::parse(line.as_bytes())?;
    Sentence::read_frame(&frame).map(|sentence| (sentence, frame.left_out()))
}

/// Reads a line without a checksum.
fn bare(line: &str) -> Result<Sentence, NmeaFault> {
    Sentence::read_frame(&Frame::parse_with(line.as_bytes(), ChecksumPolicy::Optional)?)
}

/// One field, and its number.
fn one(field: u8) -> LeftOut {
    LeftOut { count: 1, first: Some(NmeaFault::Malformed { field }) }
}

#[test]
fn a_variation_of_999_costs_an_rmc_neither_velocity_nor_date() {
    let line = "$GPRMC,113938.50,A,3842.86006889,N,11705.43645510,W,0.011,46.405,231122,\
                999.9000,E,D*2E";
    let (Sentence::Rmc(rmc), left_out) = read(line) else { panic!() };
    assert_eq!((rmc.variation, left_out), (None, one(10)));
    assert!((rmc.speed.unwrap() - 0.011 * KNOT).abs() < 1e-12 && rmc.course.is_some());
    assert_eq!(rmc.date, Some(Date { year: 2022, month: 11, day: 23 }));
    assert!(rmc.valid && rmc.position.is_some() && rmc.mode.is_some());
}

#[test]
fn a_negative_orientation_costs_a_gst_no_sigma() {
    let (Sentence::Gst(gst), left_out) =
        read("$GPGST,213122.000,15.7,22.8,11.6,-1.1,0.4,0.6,1.3*76")
    else {
        panic!()
    };
    let sigmas = [gst.latitude_std, gst.longitude_std, gst.altitude_std];
    assert_eq!((sigmas, gst.orientation), ([Some(0.4), Some(0.6), Some(1.3)], None));
    assert_eq!(left_out, one(5));
}

#[test]
fn a_fourth_dilution_is_no_system_and_costs_a_gsa_nothing() {
    let (Sentence::Gsa(gsa), left_out) = read("$GPGSA,A,3,25,32,,,,,,,,,,,5.1,1.3,4.9,3.3*3D")
    else {
        panic!()
    };
    assert_eq!((gsa.pdop, gsa.hdop, gsa.vdop), (Some(5.1), Some(1.3), Some(4.9)));
    assert_eq!((gsa.system, left_out), (None, one(18)));
}

#[test]
fn short_forms_without_a_checksum_are_read_where_the_port_allows_it() {
    let Ok(Sentence::Zda(zda)) = bare("$GPZDA,000000,01,08,2014,7") else { panic!() };
    let date = Date { year: 2014, month: 8, day: 1 };
    assert_eq!(zda.utc, Some(CivilTime { date, time: TimeOfDay::default() }));
    assert_eq!(zda.zone.map(|zone| (zone.hours, zone.minutes)), Some((7, 0)));
    let Ok(Sentence::Gll(gll)) = bare("$GPGLL,2200.097,S,01756.346,W") else { panic!() };
    let position = gll.position.unwrap();
    assert!((position.latitude.to_degrees() + 22.0 + 0.097 / 60.0).abs() < 1e-12);
    assert!((position.longitude.to_degrees() + 17.0 + 56.346 / 60.0).abs() < 1e-12);
    assert_eq!((gll.valid, gll.time, gll.mode), (true, None, None));
    let Ok(Sentence::Vtg(vtg)) = bare("$GPVTG,220.6,T,,M,009.7,N,018.0,K") else { panic!() };
    assert!((vtg.speed.unwrap() - 9.7 * KNOT).abs() < 1e-12);
    assert_eq!(
        Frame::parse(b"$GPZDA,000000,01,08,2014,7").map(|frame| frame.left_out()),
        Err(NmeaFault::NoChecksum)
    );
}

#[test]
fn a_short_form_cut_short_is_no_shorter_form() {
    // made: what is left of the short forms when bytes are lost at their ends
    for line in ["$GPZDA,000000,01,08,201", "$GPZDA,000000,01,08", "$GPGLL,2200.097,S,01756.346"] {
        assert!(bare(line).is_err(), "{line}");
    }
    let (Ok(Sentence::Zda(whole)), Ok(Sentence::Zda(without))) =
        (bare("$GPZDA,000000,01,08,2014,7"), bare("$GPZDA,000000,01,08,2014"))
    else {
        panic!()
    };
    assert_eq!(Zda { zone: None, ..whole }, without);
}

#[test]
fn a_year_of_two_digits_has_a_century() {
    // a B&G Zeus behind GoFree (Signal K)
    let (Sentence::Zda(zda), left_out) = read("$GPZDA,195719,16,04,14,-02,00*63") else { panic!() };
    let date = zda.utc.unwrap().date;
    assert_eq!((date, left_out), (Date { year: 2014, month: 4, day: 16 }, LeftOut::default()));
    let Ok((Sentence::Zda(old), _)) = framed("$GPZDA,195719,16,04,94,00,00") else { panic!() };
    assert_eq!(old.utc.unwrap().date.year, 1994);
    assert!(framed("$GPZDA,195719,16,04,20").is_err(), "2014, cut short");
}

#[test]
fn a_time_without_a_date_is_no_time_and_is_noted() {
    let (Sentence::Zda(zda), left_out) = read("$GPZDA,095559,,,,00,*4D") else { panic!() };
    assert_eq!((zda.utc, left_out), (None, one(2)));
}

#[test]
fn each_field_that_a_sentence_is_good_without_may_be_bad() {
    // made: good sentences with one field spoilt after the other
    let sentences: [(&str, &[u8]); 9] = [
        (
            "$GPGGA,120000,3500.0,N,13900.0,E,1,08,1.0,20.0,M,36.0,M,2.0,0120",
            &[7, 8, 9, 10, 11, 12, 13, 14],
        ),
        (
            "$GNGNS,120000,3500.0,N,13900.0,E,AA,08,1.0,20.0,36.0,2.0,0120,S",
            &[7, 8, 9, 10, 11, 12, 13],
        ),
        ("$GPRMC,120000,A,3500.0,N,13900.0,E,5.0,90.0,280226,7.0,W,A,S", &[7, 8, 9, 10, 11, 13]),
        ("$GPVTG,90.0,T,97.0,M,5.0,N,9.3,K,A", &[1, 2, 3, 4, 5, 6, 7, 8]),
        ("$GPGST,120000,1.0,2.0,1.0,30.0,1.0,1.0,2.0", &[2, 3, 4, 5, 6, 7, 8]),
        (
            "$GPGSA,A,3,01,02,03,04,05,06,07,08,09,10,11,12,2.0,1.0,1.7,1",
            &[1, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18],
        ),
        ("$HCHDG,90.0,1.0,E,7.0,W", &[4, 5]),
        ("$GPZDA,120000,28,02,2026,07,00", &[5, 6]),
        ("$VDVBW,10.0,0.1,A,10.1,0.2,A,0.1,A,0.1,A", &[1, 2, 3, 4, 5, 6, 7, 8, 9, 10]),
    ];
    for (line, optional) in sentences {
        let (_, none) = framed(line).unwrap();
        assert_eq!(none, LeftOut::default(), "{line}");
        let fields: Vec<&str> = line.split(',').collect();
        for field in 1..fields.len() {
            let mut spoilt = fields.clone();
            spoilt[field] = "#x";
            let spoilt = spoilt.join(",");
            let number = u8::try_from(field).unwrap();
            match framed(&spoilt) {
                Ok((_, left_out)) => {
                    assert!(optional.contains(&number), "{spoilt}");
                    assert_eq!(left_out.count, 1, "{spoilt}");
                }
                Err(NmeaFault::Malformed { .. }) => {
                    assert!(!optional.contains(&number), "{spoilt}");
                }
                Err(fault) => panic!("{spoilt}: {fault}"),
            }
        }
    }
}

#[test]
fn what_is_left_out_is_unknown_and_never_zero() {
    let spoilt = |line: &str| framed(line).unwrap().0;
    let gga = "$GPGGA,120000,3500.0,N,13900.0,E,1,x,-1.0,20.0,F,1e3,M,x,x";
    let Sentence::Gga(Gga { satellites, hdop, altitude, geoid_separation, age, station, .. }) =
        spoilt(gga)
    else {
        panic!()
    };
    assert_eq!((satellites, hdop, altitude, geoid_separation), (None, None, None, None));
    assert_eq!((age, station), (None, None));
    let rmc = "$GPRMC,120000,A,3500.0,N,13900.0,E,-5.0,400.0,310226,7.0,X,A";
    let Sentence::Rmc(Rmc { speed, course, date, variation, .. }) = spoilt(rmc) else { panic!() };
    assert_eq!((speed, course, date, variation), (None, None, None, None));
    let Sentence::Vtg(Vtg { course, speed, .. }) = spoilt("$GPVTG,90.0,M,,T,5.0,K,9.3,N,A") else {
        panic!()
    };
    assert_eq!((course, speed), (None, None));
    let Sentence::Vbw(Vbw { water, ground, .. }) = spoilt("$VDVBW,x,0.1,Q,10.1,0.2,A") else {
        panic!()
    };
    assert!(water.longitudinal.is_none() && !water.valid && ground.valid);
    let Sentence::Hdg(Hdg { variation, .. }) = spoilt("$HCHDG,90.0,,,181.0,W") else { panic!() };
    assert_eq!(variation, None);
    let Sentence::Gst(Gst { latitude_std, .. }) = spoilt("$GPGST,120000,,,,,-1.0,1.0,2.0") else {
        panic!()
    };
    let Sentence::Gsa(Gsa { hdop, .. }) = spoilt("$GPGSA,A,3,,,,,,,,,,,,,2.0,x,1.7") else {
        panic!()
    };
    assert_eq!((latitude_std, hdop), (None, None));
}

#[test]
fn what_a_sentence_is_for_may_not_be_bad() {
    // made: time, position, status, mode, heading and deviation
    for line in [
        "$GPGGA,1200x0,3500.0,N,13900.0,E,1,08,1.0,20.0,M,36.0,M,,",
        "$GPRMC,120000,A,3560.0,N,13900.0,E,5.0,90.0,280226,,,A",
        "$GPRMC,120000,X,3500.0,N,13900.0,E,5.0,90.0,280226,,,A",
        "$GPRMC,120000,A,3500.0,N,13900.0,E,5.0,90.0,280226,,,Q",
        "$GPGLL,3500.0,N,13900.0,X",
        "$HEHDT,361.0,T",
        "$HCHDG,90.0,x,E,7.0,W",
        "$GPZDA,120000,31,02,2026,,",
    ] {
        assert!(framed(line).is_err(), "{line}");
    }
    let Ok((Sentence::Gll(Gll { position: None, valid: false, .. }), _)) = framed("$GPGLL,,,,")
    else {
        panic!()
    };
}
