//! SBF blocks as JSON.

use insd_wire::gnss::sbf::{
    AttCovEuler, AttEuler, BaseVector, BaseVectorGeod, MeasChannel, MeasEpoch, MeasOther,
    PvtCartesian, PvtGeodetic, RawNavigation, RawNavigationKind, ReceiverTime, SbfCovariance,
    SbfMessage, SbfMode, SbfStamp, XppsOffset,
};
use serde_json::{Value, json};

/// Name and fields of a block; no fields if it is not read, `refused` and why if it can not be.
pub(crate) fn describe(block: &[u8]) -> (String, Value) {
    let message = match SbfMessage::read(block) {
        Ok(message) => message,
        Err(fault) => return ("refused".to_owned(), json!(fault.to_string())),
    };
    let (name, fields) = match &message {
        SbfMessage::PvtGeodetic(block) => ("PVTGeodetic", pvt(block)),
        SbfMessage::PvtCartesian(block) => ("PVTCartesian", cartesian(block)),
        SbfMessage::BaseVectorGeod(block) => ("BaseVectorGeod", vectors(block)),
        SbfMessage::PosCovGeodetic(block) => ("PosCovGeodetic", cov(&block.0)),
        SbfMessage::VelCovGeodetic(block) => ("VelCovGeodetic", cov(&block.0)),
        SbfMessage::AttEuler(block) => ("AttEuler", attitude(block)),
        SbfMessage::AttCovEuler(block) => ("AttCovEuler", attitude_cov(block)),
        SbfMessage::ReceiverTime(block) => ("ReceiverTime", time(block)),
        SbfMessage::XppsOffset(block) => ("xPPSOffset", pulse(block)),
        SbfMessage::MeasEpoch(block) => ("MeasEpoch", measurements(block)),
        SbfMessage::RawNavigation(block) => (raw_name(block.kind), raw(block)),
        SbfMessage::Other { id, revision } => return (format!("{id}-{revision}"), Value::Null),
    };
    (name.to_owned(), fields)
}

fn with(stamp: SbfStamp, mode: Option<SbfMode>, mut fields: Value) -> Value {
    fields["TOW"] = json!(stamp.time_of_week);
    fields["WNc"] = json!(stamp.week);
    if let Some(mode) = mode {
        fields["Type"] = json!(mode.solution.raw());
        fields["AutoSet"] = json!(mode.determining);
        fields["2D"] = json!(mode.two_dimensional);
        fields["Error"] = json!(mode.error);
    }
    fields
}

fn pvt(block: &PvtGeodetic) -> Value {
    let (position, extra) = (block.position, block.extra);
    let fields = json!({
        "Latitude": position.map(|position| position.latitude),
        "Longitude": position.map(|position| position.longitude),
        "Height": position.map(|position| position.height), "Undulation": block.undulation,
        "Vn": block.velocity[0], "Ve": block.velocity[1], "Vd": block.velocity[2],
        "COG": block.course, "RxClkBias": block.clock_bias, "RxClkDrift": block.clock_drift,
        "TimeSystem": block.time_system, "Datum": block.datum, "NrSV": block.satellites,
        "ReferenceID": block.reference, "MeanCorrAge": block.correction_age,
        "SignalInfo": block.signals, "NrBases": extra.map(|extra| extra.bases),
        "Latency": extra.and_then(|extra| extra.latency),
        "HAccuracy": extra.and_then(|extra| extra.horizontal),
        "VAccuracy": extra.and_then(|extra| extra.vertical),
    });
    with(block.stamp, Some(block.mode), fields)
}

fn cartesian(block: &PvtCartesian) -> Value {
    let (position, velocity, extra) = (block.position, block.velocity, block.extra);
    let fields = json!({
        "X": position.map(|own| own[0]), "Y": position.map(|own| own[1]),
        "Z": position.map(|own| own[2]), "Undulation": block.undulation,
        "Vx": velocity.map(|own| own[0]), "Vy": velocity.map(|own| own[1]),
        "Vz": velocity.map(|own| own[2]), "NrSV": block.satellites,
        "NrBases": extra.map(|extra| extra.bases),
        "Latency": extra.and_then(|extra| extra.latency),
        "HAccuracy": extra.and_then(|extra| extra.horizontal),
        "VAccuracy": extra.and_then(|extra| extra.vertical),
    });
    with(block.stamp, Some(block.mode), fields)
}

fn vectors(block: &BaseVectorGeod) -> Value {
    let vector = |own: &BaseVector| {
        json!({
            "NrSV": own.satellites, "Error": own.mode.error, "Mode": own.mode.solution.raw(),
            "Misc": own.misc, "DeltaNorth": own.relative[0], "DeltaEast": own.relative[1],
            "DeltaDown": own.relative[2], "DeltaVn": own.velocity[0],
            "DeltaVe": own.velocity[1], "DeltaVd": own.velocity[2], "Azimuth": own.direction.0,
            "Elevation": own.direction.1, "ReferenceID": own.reference,
            "CorrAge": own.correction_age, "SignalInfo": own.signals,
        })
    };
    let vectors: Vec<_> = block.vectors.iter().map(vector).collect();
    with(block.stamp, None, json!({ "vectors": vectors }))
}

fn cov(block: &SbfCovariance) -> Value {
    let fields = json!({ "variances": block.variances, "covariances": block.covariances });
    with(block.stamp, Some(block.mode), fields)
}

fn attitude(block: &AttEuler) -> Value {
    let fields = json!({
        "NrSV": block.satellites, "Error": block.error, "Mode": block.mode,
        "Heading": block.heading, "Pitch": block.pitch, "Roll": block.roll,
        "PitchDot": block.rates[0], "RollDot": block.rates[1], "HeadingDot": block.rates[2],
    });
    with(block.stamp, None, fields)
}

fn attitude_cov(block: &AttCovEuler) -> Value {
    let fields = json!({
        "Error": block.error, "variances": block.variances, "covariances": block.covariances,
    });
    with(block.stamp, None, fields)
}

fn time(block: &ReceiverTime) -> Value {
    let utc = block.utc.and_then(insd_wire::nmea::CivilTime::to_utc);
    let fields = json!({
        "utc": utc.map(insd_base::UtcTime::as_nanos), "DeltaLS": block.leap_seconds,
        "SyncLevel": block.sync,
    });
    with(block.stamp, None, fields)
}

fn pulse(block: &XppsOffset) -> Value {
    let fields = json!({
        "SyncAge": block.age, "TimeScale": block.scale, "Offset": block.offset,
        "pulse": block.pulse().as_ref().map(crate::ubx::instant),
    });
    with(block.stamp, None, fields)
}

fn measurements(block: &MeasEpoch) -> Value {
    let other = |own: &MeasOther| {
        json!({
            "Type": own.kind, "LockTime": own.lock_time, "CN0": own.density, "OffsetMSB": own.high,
            "CarrierMSB": own.carrier_high, "ObsInfo": own.info, "CodeOffsetLSB": own.code_low,
            "CarrierLSB": own.carrier_low, "DopplerOffsetLSB": own.doppler_low,
        })
    };
    let channel = |own: &MeasChannel| {
        json!({
            "RxChannel": own.receiver_channel, "Type": own.kind, "SVID": own.satellite,
            "Misc": own.misc, "CodeLSB": own.code, "Doppler": own.doppler,
            "CarrierLSB": own.carrier_low, "CarrierMSB": own.carrier_high, "CN0": own.density,
            "LockTime": own.lock_time, "ObsInfo": own.info,
            "Type2": own.others.iter().map(other).collect::<Vec<_>>(),
        })
    };
    let channels: Vec<_> = block.channels.iter().map(channel).collect();
    let fields = json!({
        "CommonFlags": block.flags, "CumClkJumps": block.clock_jumps, "Type1": channels,
    });
    with(block.stamp, None, fields)
}

fn raw_name(kind: RawNavigationKind) -> &'static str {
    match kind {
        RawNavigationKind::Gps => "GPSRawCA",
        RawNavigationKind::GalileoFnav => "GALRawFNAV",
        RawNavigationKind::GalileoInav => "GALRawINAV",
        RawNavigationKind::Glonass => "GLORawCA",
        RawNavigationKind::BeiDou => "BDSRaw",
        RawNavigationKind::Qzss => "QZSRawL1CA",
    }
}

fn raw(block: &RawNavigation) -> Value {
    let fields = json!({
        "SVID": block.satellite, "CRCPassed": block.passed, "ViterbiCnt": block.mended,
        "Source": block.source, "FreqNr": block.frequency, "RxChannel": block.receiver_channel,
        "NAVBits": block.words,
    });
    with(block.stamp, None, fields)
}
