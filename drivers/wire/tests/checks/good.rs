//! Any bytes as the contents of frames whose lengths and checksums are good. A fuzzer does not find a
//! checksum by itself; behind one it would never get to the fields.
//!
//! Where the library makes the frame of any payload its own function is used. The others are made here,
//! with sums of their own, from the layouts that the modules of the formats describe.

use insd_wire::gnss::{gsof, novatel, rtcm, sbf, ubx};
use insd_wire::log::ad2cp;
use insd_wire::nmea::{Sentence, checksum};
use insd_wire::stream::{Look, Protocol};

/// The frames of a protocol that some bytes are made into. The first byte chooses which message it is.
pub(crate) fn frames(protocol: Protocol, bytes: &[u8]) -> Vec<Vec<u8>> {
    let Some((choice, rest)) = bytes.split_first() else { return Vec::new() };
    match protocol {
        Protocol::Nmea => vec![sentence(*choice, rest), line(bytes)],
        Protocol::Ubx => vec![ubx_frame(*choice, rest)],
        Protocol::Sbf => vec![sbf_frame(*choice, rest)],
        Protocol::Rtcm => vec![rtcm::Frame { message: bytes }.write()],
        Protocol::Sbg => vec![sbg_frame(*choice, rest)],
        Protocol::StdBin => vec![stdbin_frame(*choice, rest)],
        Protocol::Mip => vec![mip_frame(bytes)],
        Protocol::Xbus => vec![xbus_frame(bytes)],
        Protocol::Kvh => vec![kvh_frame(*choice, rest)],
        Protocol::Stim => vec![stim_frame(*choice, rest)],
        Protocol::Pd0 => vec![pd0_frame(*choice, rest)],
        Protocol::Pd6 => vec![pd6_line(*choice, rest)],
        Protocol::Novatel => vec![novatel_frame(*choice, rest)],
        Protocol::Kmb => vec![kmb_frame(bytes)],
        Protocol::Em3000 => vec![em_frame(*choice, rest)],
        Protocol::Tss1 => vec![tss1_line(bytes)],
        Protocol::Ngt1 => vec![ngt_frame(*choice, rest)],
        Protocol::Gsof => gsof_pages(*choice, rest),
        Protocol::VectorNav => vec![vectornav_frame(*choice, rest)],
        Protocol::Ad2cp => vec![ad2cp_frame(*choice, rest)],
        Protocol::SignalK => vec![server_line(*choice, rest)],
    }
}

/// One of a few, by any byte.
fn chosen<T: Copy>(of: &[T], choice: u8) -> T {
    of[usize::from(choice) % of.len()]
}

/// So many bytes, filled up with zeros.
fn filled(bytes: &[u8], length: usize) -> Vec<u8> {
    let mut filled = bytes.to_vec();
    filled.resize(length, 0);
    filled
}

/// A sentence that is read, with any fields.
fn sentence(choice: u8, fields: &[u8]) -> Vec<u8> {
    let name = chosen(Sentence::NAMES, choice);
    let talker = if name.starts_with('P') && name != "P" { "" } else { "GP" };
    line(&[talker.as_bytes(), name.as_bytes(), b",", fields].concat())
}

fn line(content: &[u8]) -> Vec<u8> {
    let sum = format!("*{:02X}\r\n", checksum(content));
    [b"$", content, sum.as_bytes()].concat()
}

/// Class and id of the messages that are read, and of one that is not.
const UBX: [(u8, u8); 16] = [
    (0x01, 0x07),
    (0x01, 0x04),
    (0x01, 0x36),
    (0x01, 0x14),
    (0x01, 0x20),
    (0x01, 0x26),
    (0x0D, 0x01),
    (0x02, 0x15),
    (0x02, 0x13),
    (0x0A, 0x04),
    (0x01, 0x02),
    (0x01, 0x03),
    (0x01, 0x06),
    (0x01, 0x12),
    (0x01, 0x21),
    (0x01, 0x3C),
];

fn ubx_frame(choice: u8, payload: &[u8]) -> Vec<u8> {
    let (class, id) = chosen(&UBX, choice);
    ubx::Frame { class, id, payload }.write()
}

/// Numbers of the blocks that are read, and of two that are not.
const SBF: [u16; 18] = [
    4007, 5906, 5908, 5938, 5939, 5914, 5911, 4027, 4017, 4022, 4023, 4026, 4047, 4066, 4000, 4018,
    4006, 4028,
];

fn sbf_frame(choice: u8, payload: &[u8]) -> Vec<u8> {
    sbf::Frame { id: chosen(&SBF, choice), revision: choice >> 5, payload }.write()
}

/// Ids of the logs that are read, and of one that is not.
const SBG: [u8; 5] = [2, 3, 6, 44, 1];

fn sbg_frame(choice: u8, data: &[u8]) -> Vec<u8> {
    let length = u16::try_from(data.len().min(4086)).unwrap_or_default();
    let data = &data[..length.into()];
    let covered = [&[chosen(&SBG, choice), 0][..], &length.to_le_bytes(), data].concat();
    let crc = covered.iter().fold(0_u16, |crc, byte| {
        (0..8)
            .fold(crc ^ u16::from(*byte), |crc, _| crc >> 1 ^ if crc & 1 == 1 { 0x8408 } else { 0 })
    });
    [&[0xFF, 0x5A][..], &covered, &crc.to_le_bytes(), &[0x33]].concat()
}

/// Bytes of the masks come first, then, from version 4 on, the bytes of the navigation blocks.
fn stdbin_frame(choice: u8, bytes: &[u8]) -> Vec<u8> {
    let version = 2 + choice % 4;
    let masks = if version > 2 { 12 } else { 8 };
    let told = if version > 3 { 2 } else { 0 };
    let head = filled(&bytes[..bytes.len().min(masks + told)], masks + told);
    let rest = &bytes[bytes.len().min(masks + told)..];
    let rest = filled(&rest[..rest.len().min(1500)], rest.len().clamp(8, 1500));
    let length = 3 + masks + told + 2 + rest.len() + 4;
    let length = u16::try_from(length).unwrap_or_default().to_be_bytes();
    let summed = [b"IX", &[version][..], &head, &length, &rest].concat();
    let sum: u32 = summed.iter().map(|byte| u32::from(*byte)).sum();
    [&summed[..], &sum.to_be_bytes()].concat()
}

/// Descriptors of the fields that are read, and of one that is not.
const MIP: [u8; 12] = [0x04, 0x05, 0x07, 0x08, 0x0C, 0x12, 0x14, 0x18, 0xD3, 0xD5, 0xD6, 0x06];

/// Fields of sensor data: a byte for the descriptor, one for the length, the data.
fn mip_frame(mut bytes: &[u8]) -> Vec<u8> {
    let mut fields = Vec::new();
    while let [descriptor, length, rest @ ..] = bytes {
        let length = usize::from(length % 16).min(rest.len());
        if fields.len() + length + 2 > 255 {
            break;
        }
        fields.extend([u8::try_from(length + 2).unwrap_or_default(), chosen(&MIP, *descriptor)]);
        fields.extend(&rest[..length]);
        bytes = &rest[length..];
    }
    let length = u8::try_from(fields.len()).unwrap_or_default();
    let summed = [&[0x75, 0x65, 0x80, length][..], &fields].concat();
    let (first, second) = summed.iter().fold((0_u8, 0_u8), |(first, second), byte| {
        let first = first.wrapping_add(*byte);
        (first, second.wrapping_add(first))
    });
    [&summed[..], &[first, second]].concat()
}

/// Items that are read, without the bits of number format and axes, and one that is not.
const XBUS: [u16; 13] = [
    0x0810, 0x1010, 0x1020, 0x1060, 0x1070, 0x2030, 0x4010, 0x4020, 0x8020, 0x8030, 0xE010, 0xE020,
    0xC020,
];

/// Items of MTData2: a byte for the item, one for its number format and axes and its size, the data.
fn xbus_frame(mut bytes: &[u8]) -> Vec<u8> {
    let mut items = Vec::new();
    while let [item, form, rest @ ..] = bytes {
        let size = usize::from(form >> 4) * 4;
        let size = size.min(rest.len());
        if items.len() + size + 3 > 2048 {
            break;
        }
        items.extend((chosen(&XBUS, *item) | u16::from(form & 15)).to_be_bytes());
        items.push(u8::try_from(size).unwrap_or_default());
        items.extend(&rest[..size]);
        bytes = &rest[size..];
    }
    let length = u16::try_from(items.len()).unwrap_or_default();
    let head = match u8::try_from(length) {
        Ok(short) if short < 0xFF => vec![0xFF, 0x36, short],
        _ => [&[0xFF, 0x36, 0xFF][..], &length.to_be_bytes()].concat(),
    };
    let summed = [head, items].concat();
    let sum = summed.iter().fold(0_u8, |sum, byte| sum.wrapping_add(*byte));
    [&[0xFA][..], &summed, &[sum.wrapping_neg()]].concat()
}

/// CRC-32 with the polynomial 04C11DB7, all ones at first, not reflected.
fn crc(bytes: &[u8]) -> u32 {
    bytes.iter().fold(u32::MAX, |crc, byte| {
        (0..8).fold(crc ^ u32::from(*byte) << 24, |crc, _| {
            crc << 1 ^ if crc >> 31 == 1 { 0x04C1_1DB7 } else { 0 }
        })
    })
}

/// The length of a frame by its first bytes.
fn length_of(protocol: Protocol, start: &[u8]) -> usize {
    match protocol.look(start) {
        Look::More(length) => length,
        look => panic!("{start:?}: {look:?}"),
    }
}

fn kvh_frame(choice: u8, bytes: &[u8]) -> Vec<u8> {
    let start = [0xFE, 0x81, 0xFF, 0x55 + choice % 3];
    let length = length_of(Protocol::Kvh, &start) - start.len() - 4;
    let body = [&start[..], &filled(bytes, length)].concat();
    [&body[..], &crc(&body).to_be_bytes()].concat()
}

fn stim_frame(choice: u8, bytes: &[u8]) -> Vec<u8> {
    let ids = (0x90..=u8::MAX).filter(|id| Protocol::Stim.look(&[*id]) != Look::Nothing);
    let id = chosen(&ids.collect::<Vec<u8>>(), choice);
    let length = length_of(Protocol::Stim, &[id]) - 5;
    let body = [&[id][..], &filled(bytes, length)].concat();
    let summed = filled(&body, body.len().next_multiple_of(4));
    [&body[..], &crc(&summed).to_be_bytes()].concat()
}

/// An ensemble of both leaders and the bottom track, each with so many bytes as two bytes say, or, if
/// the choice is odd, as their documents say.
fn pd0_frame(choice: u8, mut bytes: &[u8]) -> Vec<u8> {
    let (mut offsets, mut types) = (Vec::new(), Vec::new());
    for (id, usual) in [(0x0000_u16, 59), (0x0080, 65), (0x0600, 85)] {
        let length = match bytes {
            [length, rest @ ..] if choice.is_multiple_of(2) => {
                bytes = rest;
                usize::from(*length % 128)
            }
            _ => usual - 2,
        };
        let (own, rest) = bytes.split_at(length.min(bytes.len()));
        bytes = rest;
        offsets.extend(u16::try_from(12 + types.len()).unwrap_or_default().to_le_bytes());
        types.extend(id.to_le_bytes());
        types.extend(filled(own, length));
    }
    let length = u16::try_from(12 + types.len() + 2).unwrap_or_default().to_le_bytes();
    let summed = [&[0x7F, 0x7F][..], &length, &[0, 3], &offsets, &types, &[0; 2]].concat();
    let sum = summed.iter().fold(0_u16, |sum, byte| sum.wrapping_add(u16::from(*byte)));
    [&summed[..], &sum.to_le_bytes()].concat()
}

/// Numbers of the logs that are read, and of one that is not.
const NOVATEL: [u16; 15] =
    [42, 1429, 99, 1430, 1335, 2042, 507, 508, 1465, 268, 325, 1461, 1462, 101, 43];

/// The time of the header comes first, then what it carries.
fn novatel_frame(choice: u8, bytes: &[u8]) -> Vec<u8> {
    let time = filled(&bytes[..bytes.len().min(7)], 7);
    let header = novatel::Header {
        id: chosen(&NOVATEL, choice),
        short: choice & 0x40 != 0,
        response: choice & 0x80 != 0,
        time_status: if choice & 0x40 != 0 { 0 } else { time[0] },
        week: u16::from_le_bytes([time[1], time[2]]),
        milliseconds: i32::from_le_bytes([time[3], time[4], time[5], time[6]]),
    };
    header.write(&filled(&bytes[bytes.len().min(7)..], bytes.len().max(133)))
}

/// KM binary with a fraction below a second, or most would be refused for it.
fn kmb_frame(bytes: &[u8]) -> Vec<u8> {
    let mut body = filled(&bytes[..bytes.len().min(124)], 124);
    body[7] &= 0x1F;
    [&b"#KMB\x84\x00\x01\x00"[..], &body].concat()
}

/// EM3000 of which heave is in its range, or most would be none.
fn em_frame(choice: u8, bytes: &[u8]) -> Vec<u8> {
    let mut body = filled(&bytes[..bytes.len().min(8)], 8);
    body[5] &= 1;
    [&[0x90 | choice & 0x0F, 0x90][..], &body].concat()
}

/// A telegram of TSS1 whose every character is one of those that can stand at its place.
fn tss1_line(bytes: &[u8]) -> Vec<u8> {
    let body = filled(&bytes[..bytes.len().min(24)], 24);
    let of = |place: usize, set: &[u8]| chosen(set, body[place]);
    let character = |place: usize| match place {
        0..=5 => of(place, b"0123456789ABCDEFabcdef"),
        6 | 18 => b' ',
        7 | 13 | 19 => of(place, b" -"),
        12 => of(place, b"UGHFughf"),
        _ => of(place, b"0123456789"),
    };
    let inner: Vec<u8> = (0..24).map(character).collect();
    [b":", &inner[..], b"\r\n"].concat()
}

/// A message of the bus of any contents, or any contents that are called one, or something of the adapter itself.
fn ngt_frame(choice: u8, bytes: &[u8]) -> Vec<u8> {
    let command = chosen(&[0x93, 0x93, 0x93, 0xA0], choice);
    let mut contents = bytes[..bytes.len().min(234)].to_vec();
    if choice & 0x80 == 0 && contents.len() > 10 {
        contents[0] &= 7;
        contents[3] &= 3;
        contents[10] = (contents.len() - 11) as u8;
    }
    let mut plain = vec![command, contents.len() as u8];
    plain.extend(contents);
    plain.push(plain.iter().fold(0_u8, |sum, byte| sum.wrapping_sub(*byte)));
    let doubled = plain.iter().flat_map(|byte| vec![*byte; if *byte == 0x10 { 2 } else { 1 }]);
    [0x10, 0x02].into_iter().chain(doubled).chain([0x10, 0x03]).collect()
}

/// Types of the records that are read, and of one that is not, with the bytes that they have.
const GSOF: [(u8, usize); 8] =
    [(1, 10), (2, 24), (8, 13), (9, 16), (12, 38), (16, 9), (27, 70), (3, 24)];

/// A report of records that the choice and then each record's first byte choose.
fn gsof_pages(mut choice: u8, mut bytes: &[u8]) -> Vec<Vec<u8>> {
    let mut records = Vec::new();
    while records.len() < 1000 {
        let (kind, length) = chosen(&GSOF, choice);
        records.extend([kind, length as u8]);
        records.extend(filled(&bytes[..bytes.len().min(length)], length));
        let Some((next, rest)) = bytes[bytes.len().min(length)..].split_first() else { break };
        (choice, bytes) = (*next, rest);
    }
    gsof::Page::pages(choice, &records).iter().map(gsof::Page::write).collect()
}

/// Groups and masks of which the fields have known sizes, by the choice; the rest is what stands in them.
fn vectornav_frame(choice: u8, bytes: &[u8]) -> Vec<u8> {
    const HEADS: [&[u8]; 6] = [
        &[0xFA, 0x01, 0xFF, 0x7F],
        &[0xFA, 0x04, 0xFF, 0x0F],
        &[0xFA, 0x16, 0xFF, 0x03, 0xFF, 0x0F, 0x02, 0x01],
        &[0xFA, 0x05, 0x08, 0x18, 0xD0, 0x00],
        &[0xFA, 0x31, 0x08, 0x00, 0x02, 0x31, 0x01, 0x00],
        &[0xFA, 0x08, 0xFF, 0x00],
    ];
    let head = chosen(&HEADS, choice);
    let length = length_of(Protocol::VectorNav, head) - head.len() - 2;
    let body = [&head[1..], &filled(bytes, length)].concat();
    let crc = body.iter().fold(0_u16, |crc, byte| {
        (0..8).fold(crc ^ u16::from(*byte) << 8, |crc, _| {
            crc << 1 ^ if crc >> 15 == 1 { 0x1021 } else { 0 }
        })
    });
    [&[0xFA][..], &body, &crc.to_be_bytes()].concat()
}

/// A record of bottom track of which version, offset, beams and scaling are sane, or most would be refused for them; or another.
fn ad2cp_frame(choice: u8, bytes: &[u8]) -> Vec<u8> {
    let mut data = filled(bytes, bytes.len().max(118));
    data[0] = 1;
    data[1] = if choice & 0x40 == 0 { 78 } else { data[1] };
    data[31] = data[31] & 0x0F | 0x10 << (choice & 3).min(2);
    data[60] = (-i16::from(data[60] % 10)) as u8;
    ad2cp::frame(if choice & 0x80 == 0 { 0x17 } else { 0x15 }, &data)
}

/// Names of the lines that are read, and of one that is not.
const PD6: [&str; 11] = ["SA", "TS", "BI", "BS", "BE", "BD", "WI", "WS", "WE", "WD", "RA"];

fn pd6_line(choice: u8, fields: &[u8]) -> Vec<u8> {
    [b":", chosen(&PD6, choice).as_bytes(), b",", fields, b"\r\n"].concat()
}

/// A delta with any text as the value of a path that is read, which may be no JSON.
fn server_line(choice: u8, value: &[u8]) -> Vec<u8> {
    const PATHS: [&str; 4] = ["headingTrue", "headingMagnetic", "speedThroughWater", "position"];
    let path = chosen(&PATHS, choice);
    let value = String::from_utf8_lossy(value);
    format!(
        "{{\"updates\":[{{\"values\":[{{\"path\":\"navigation.{path}\",\"value\":{value}}}]}}]}}\r\n"
    )
    .into_bytes()
}
