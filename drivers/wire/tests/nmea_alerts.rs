//! Sentences of alerts, signs of life and texts: what is written is read back, and a list or a text
//! of any length comes whole.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests are not seen as tests

mod common;

use common::{read, time_of_day};
use insd_wire::nmea::{
    Acn, Alc, AlertCategory, AlertCommand, AlertEntry, AlertId, AlertPriority, AlertState, Alf,
    Arc, Hbt, Manufacturer, NmeaFault, Sentence, Talker, Text, TimeOfDay, Txt, checksum,
};
use proptest::prelude::*;

const TIME: TimeOfDay = TimeOfDay { hour: 10, minute: 14, second: 23, nanosecond: 0 };

fn framed(text: &str) -> Result<Sentence, NmeaFault> {
    let line = format!("${text}*{:02X}", checksum(text.as_bytes()));
    Sentence::read(line.as_bytes()).map(|(_, sentence)| sentence)
}

fn manufacturer() -> impl Strategy<Value = Option<Manufacturer>> {
    prop::option::of("[A-Z0-9]{3}").prop_map(|text| text.and_then(|text| Manufacturer::new(&text)))
}

fn alert() -> impl Strategy<Value = AlertId> {
    (manufacturer(), 0..=9_999_999_u32, prop::option::of(1..=999_999_u32)).prop_map(
        |(manufacturer, identifier, instance)| AlertId { manufacturer, identifier, instance },
    )
}

fn entry() -> impl Strategy<Value = AlertEntry> {
    (alert(), prop::option::of(1..=99_u8))
        .prop_map(|(alert, revision)| AlertEntry { alert, revision })
}

fn letter<T: std::fmt::Debug>(
    letters: &'static [u8],
    from: fn(u8) -> Option<T>,
) -> impl Strategy<Value = Option<T>> {
    prop::option::of(prop::sample::select(letters)).prop_map(move |letter| letter.and_then(from))
}

fn text<const N: usize>(pattern: &'static str) -> impl Strategy<Value = Text<N>> {
    pattern.prop_map(|text| Text::new(&text).unwrap())
}

prop_compose! {
    fn alf()(
        numbers in prop::sample::select(vec![(1, 1), (2, 1)]), message in 0..=9_u8,
        time in prop::option::of(time_of_day()),
        category in letter(b"ABC", AlertCategory::from_letter),
        priority in letter(b"EAWC", AlertPriority::from_letter),
        state in letter(b"VSAOUN", AlertState::from_letter),
        alert in alert(), revision in prop::option::of(1..=99_u8),
        escalation in prop::option::of(0..=9_u8), text in text("[A-Za-z0-9 .:/-]{0,24}"),
    ) -> Alf {
        let (sentences, number) = numbers;
        Alf {
            sentences, number, message, time, category, priority, state, alert, revision,
            escalation, text,
        }
    }
}

#[test]
fn the_published_alert_is_read_and_written_but_for_the_decimals_of_its_time() {
    let published = "$SDALF,1,1,4,101423,B,C,A,JMC,230,1,5,0,DEPTH BELOW KEEL*59";
    let Ok((talker, Sentence::Alf(alf))) = Sentence::read(published.as_bytes()) else { panic!() };
    let manufacturer = Manufacturer::new("JMC");
    assert_eq!(alf.alert, AlertId { manufacturer, identifier: 230, instance: Some(1) });
    assert_eq!((alf.time, alf.revision, alf.escalation), (Some(TIME), Some(5), Some(0)));
    assert_eq!(alf.category, Some(AlertCategory::B));
    assert_eq!(alf.priority, Some(AlertPriority::Caution));
    assert_eq!(alf.state, Some(AlertState::Acknowledged));
    assert_eq!(alf.text.to_string(), "DEPTH BELOW KEEL");
    let line = alf.write(talker.unwrap());
    assert_eq!(
        line.as_str().split('*').next(),
        published.replace("101423", "101423.00",).split('*').next()
    );
}

#[test]
fn published_commands_and_refusals_are_read_and_written_but_for_the_decimals_of_their_time() {
    let text = "RAACN,220516,TCK,002,1,A,C";
    let Ok(Sentence::Acn(acn)) = framed(text) else { panic!() };
    assert_eq!((acn.alert.identifier, acn.command), (2, AlertCommand::Acknowledge));
    let written = acn.write(Talker::new("RA").unwrap());
    assert!(written.as_str().starts_with("$RAACN,220516.00,TCK,002,1,A,C*"), "{written:?}");
    let Ok(Sentence::Arc(arc)) = framed("RAARC,220516,TCK,002,1,A") else { panic!() };
    let written = arc.write(Talker::new("RA").unwrap());
    assert!(written.as_str().starts_with("$RAARC,220516.00,TCK,002,1,A*"), "{written:?}");
}

#[test]
fn a_command_without_its_flag_or_with_an_unknown_letter_is_none() {
    for (text, field) in
        [("IIACN,,,3062,1,A,", 6), ("IIACN,,,3062,1,X,C", 5), ("IIACN,,,,1,A,C", 3)]
    {
        assert_eq!(framed(text), Err(NmeaFault::Malformed { field }), "{text}");
    }
    assert_eq!(framed("IIACN,,,3062,1,A"), Err(NmeaFault::Missing { field: 6 }));
    assert_eq!(framed("INALC,01,01,00,1"), Err(NmeaFault::Missing { field: 5 }));
    assert_eq!(framed("INALC,01,02,00,0"), Err(NmeaFault::Malformed { field: 2 }));
    assert_eq!(framed("INALF,1,1,0,,B,W,X,,3062,1,1,0,T"), Err(NmeaFault::Malformed { field: 7 }));
}

#[test]
fn an_alert_with_a_description_is_two_sentences_and_the_second_repeats_no_state() {
    let alert = AlertId { manufacturer: None, identifier: 3062, instance: Some(1) };
    let title = Alf {
        sentences: 1,
        number: 1,
        message: 7,
        time: Some(TIME),
        category: Some(AlertCategory::B),
        priority: Some(AlertPriority::Warning),
        state: Some(AlertState::Unacknowledged),
        alert,
        revision: Some(1),
        escalation: Some(0),
        text: Text::new("System fault").unwrap(),
    };
    let [title, description] = title
        .with_description(Text::new("Gyro 1, check supply").unwrap())
        .map(|alf| alf.write(Talker::IN).as_str().to_owned());
    assert!(title.starts_with("$INALF,2,1,7,101423.00,B,W,V,,3062,1,1,0,System fault*"), "{title}");
    let text = "$INALF,2,2,7,,,,,,3062,1,1,0,Gyro 1^2C check supply*";
    assert!(description.starts_with(text), "{description}");
}

#[test]
fn a_list_of_no_alerts_is_one_sentence_that_says_none() {
    let [list] = Alc::list(0, &[])[..] else { panic!() };
    assert!(list.write(Talker::IN).as_str().starts_with("$INALC,01,01,00,0*"));
    assert_eq!(read(&list.write(Talker::IN)), Sentence::Alc(list));
}

#[test]
fn a_sign_of_life_has_whole_seconds_and_its_number() {
    let hbt = Hbt { interval: Some(60.0), normal: false, sequence: Some(3) };
    assert!(hbt.write(Talker::IN).as_str().starts_with("$INHBT,60,V,3*"));
    assert_eq!(read(&hbt.write(Talker::IN)), Sentence::Hbt(hbt));
}

#[test]
fn texts_of_receivers_with_their_commas_are_read() {
    let text = "$GNTXT,01,01,01,0,000222,0000,08A0,08A0,-37.124,0*62";
    let Ok((_, Sentence::Txt(txt))) = Sentence::read(text.as_bytes()) else { panic!() };
    assert_eq!(
        (txt.kind, txt.text.to_string().as_str()),
        (Some(1), "0,000222,0000,08A0,08A0,-37.124,0",)
    );
    assert_eq!(framed("GNTXT,01,01,01"), Err(NmeaFault::Missing { field: 4 }));
    assert_eq!(framed("GNTXT,01,01,01,50^"), Err(NmeaFault::Malformed { field: 4 }));
}

proptest! {
    #[test]
    fn alerts_come_back(alf in alf(), description in text("[ -~°é]{0,12}")) {
        prop_assert_eq!(read(&alf.write(Talker::IN)), Sentence::Alf(alf));
        let [title, second] = alf.with_description(description);
        prop_assert_eq!(read(&title.write(Talker::IN)), Sentence::Alf(title));
        let told = Alf { time: None, category: None, priority: None, state: None, ..second };
        prop_assert_eq!(read(&second.write(Talker::IN)), Sentence::Alf(told));
    }

    #[test]
    fn a_text_that_is_too_long_is_cut_and_nothing_else_is_lost(
        alf in alf(), text in text("[ -~]{0,64}"),
    ) {
        let Sentence::Alf(back) = read(&Alf { text, ..alf }.write(Talker::IN)) else { panic!() };
        prop_assert_eq!(Alf { text: alf.text, ..back }, alf);
        prop_assert!(text.to_string().starts_with(&back.text.to_string()));
        let room = Alf::ROOM[0].min(text.len());
        let plain = text.to_string().chars().take(room).all(|c| c.is_ascii_alphanumeric());
        let least = if plain { room } else { room / 3 };
        prop_assert!(back.text.len() >= least);
    }

    #[test]
    fn a_list_of_alerts_comes_whole_and_no_entry_is_split(
        alerts in prop::collection::vec(entry(), 0..60), message in 0..=99_u8,
    ) {
        let list = Alc::list(message, &alerts);
        let mut told = Vec::new();
        for (number, sentence) in (1..).zip(&list) {
            prop_assert_eq!((sentence.number, usize::from(sentence.sentences)), (number, list.len()));
            prop_assert_eq!(read(&sentence.write(Talker::IN)), Sentence::Alc(*sentence));
            told.extend(sentence.entries.iter().flatten().copied());
        }
        prop_assert_eq!(told, alerts);
    }

    #[test]
    fn commands_and_refusals_come_back(
        time in prop::option::of(time_of_day()), alert in alert(),
        command in prop::sample::select(b"AQOS".to_vec()),
    ) {
        let command = AlertCommand::from_letter(command).unwrap();
        let acn = Acn { time, alert, command };
        prop_assert_eq!(read(&acn.write(Talker::IN)), Sentence::Acn(acn));
        let arc = Arc { time, alert, command };
        prop_assert_eq!(read(&arc.write(Talker::IN)), Sentence::Arc(arc));
    }

    #[test]
    fn signs_of_life_come_back(
        tenths in prop::option::of(0..=9990_u32), normal: bool, sequence in prop::option::of(0..=9_u8),
    ) {
        let hbt = Hbt { interval: tenths.map(|tenths| f64::from(tenths) / 10.0), normal, sequence };
        prop_assert_eq!(read(&hbt.write(Talker::IN)), Sentence::Hbt(hbt));
    }

    #[test]
    fn a_text_of_any_length_comes_whole(kind in 0..=99_u8, text in "[ -~é]{0,400}") {
        let message = Txt::message(kind, &text);
        let mut told = String::new();
        for (number, sentence) in (1..).zip(&message) {
            let back = read(&sentence.write(Talker::IN));
            prop_assert_eq!(back, Sentence::Txt(*sentence));
            prop_assert_eq!((sentence.number, sentence.kind), (number, Some(kind)));
            told.push_str(&sentence.text.to_string());
        }
        prop_assert_eq!(told, text);
    }

    #[test]
    fn no_value_whatever_makes_a_line_too_long(
        numbers in prop::array::uniform4(any::<u8>()), identifier: u32, instance: u32,
        text in text("[ -~é]{64}"), interval: f64,
    ) {
        let [sentences, number, message, other] = numbers;
        let alert = AlertId { manufacturer: None, identifier, instance: Some(instance) };
        let other = Some(other);
        let alf = Alf {
            sentences, number, message, time: None, category: None, priority: None, state: None,
            alert, revision: other, escalation: other, text,
        };
        let entries = [Some(AlertEntry { alert, revision: other }); insd_wire::nmea::MAX_ENTRIES];
        let command = AlertCommand::Silence;
        for line in [
            alf.write(Talker::IN),
            Alc { sentences, number, message, entries }.write(Talker::IN),
            Acn { time: None, alert, command }.write(Talker::IN),
            Arc { time: None, alert, command }.write(Talker::IN),
            Txt { sentences, number, kind: other, text }.write(Talker::IN),
            Hbt { interval: Some(interval), normal: true, sequence: other }.write(Talker::IN),
        ] {
            prop_assert!(line.as_bytes().len() <= insd_wire::nmea::MAX_LEN);
            prop_assert!(line.as_str().contains(','), "nothing is left of {:?}", line);
        }
    }
}
