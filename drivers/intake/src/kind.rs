//! Kinds of sensors: what each measures, and how its bytes are framed.

use insd_wire::stream::Protocol;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The format of a sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Kind {
    /// SBG sbgECom: IMU.
    Sbg,
    /// iXblue StdBin: raw rotation and acceleration.
    Stdbin,
    /// MicroStrain MIP: IMU.
    Mip,
    /// Xsens Xbus MTData2: IMU.
    Xbus,
    /// KVH 1750 and 1775: IMU.
    Kvh,
    /// Sensonor STIM300 and 318: IMU.
    Stim,
    /// VectorNav binary: IMU.
    Vectornav,
    /// Attitude of a VectorNav device; its heading is magnetic if it has no INS.
    VectornavIns,
    /// A GNSS receiver that speaks NMEA 0183.
    NmeaGnss,
    /// A u-blox receiver.
    Ubx,
    /// A Septentrio receiver.
    Sbf,
    /// A receiver that sends its measurements in RTCM 3: MSM4 to MSM7, and orbits.
    Rtcm,
    /// A base station that sends corrections in RTCM 3: MSM4 to MSM7, and 1005 or 1006. It is not on board.
    RtcmBase,
    /// A Trimble receiver by GSOF: records 1, 2, 8, 9, 12, 16; 27 as a heading.
    Gsof,
    /// A NovAtel receiver: BESTPOS, BESTVEL, BESTGNSSPOS, BESTGNSSVEL, TIME; HEADING2 and DUALANTENNAHEADING as a heading.
    Novatel,
    /// The IMU of a NovAtel SPAN system: RAWIMUX, RAWIMUSX.
    NovatelImu,
    /// Heading of a NovAtel SPAN system: INSPVA, INSPVAS, INSPVAX.
    NovatelIns,
    /// A log that speaks NMEA 0183: VBW, VHW.
    NmeaLog,
    /// A log that speaks RDI PD0.
    Pd0,
    /// A log that speaks RDI PD6.
    Pd6,
    /// A Nortek log: PNORBT6 to 9.
    Nortek,
    /// A Nortek Signature by its binary bottom track records.
    Ad2cp,
    /// A compass: HDT, THS; HDG and HDM if `magnetic` is set.
    Compass,
    /// Heading from PSXN,23 with its quality from PSXN,20.
    Psxn,
    /// Heading from PASHR in a stated dialect.
    Pashr,
    /// Heading of a motion sensor that sends KM binary; its roll and pitch are shown.
    Kmb,
    /// Heading of a motion sensor that sends EM3000; its roll and pitch are shown.
    Em3000,
    /// Heading of an Exail (iXblue) system by StdBin; its roll and pitch are shown, and its position is for a watch.
    StdbinIns,
    /// A motion sensor that sends TSS1: its roll and pitch are shown.
    Tss1,
    /// A Hemisphere satellite compass: PSAT,HPR.
    Psat,
    /// Two antennas of a Trimble receiver: PTNL,AVR.
    Ptnl,
    /// A Furuno or JRC satellite compass: PFEC,GPatt.
    Pfec,
    /// A position from elsewhere than the ship's receivers, in NMEA 0183.
    NmeaPosition,
    /// Positions and headings typed in by an operator (PINSD).
    Manual,
    /// Heading of a Signal K server: `navigation.headingTrue`, or `headingMagnetic` if `magnetic` is set.
    SignalkHeading,
    /// Speed through the water of a Signal K server: `navigation.speedThroughWater`.
    SignalkLog,
    /// A position of a Signal K server that is not of the ship's receivers: `navigation.position`.
    SignalkPosition,
    /// Docking aids that tell a distance each: PINSD,RNG. What they measure to stands in `[[ranging]]`.
    Ranging,
    /// A local position reference, CyScan or RadaScan: RLS. Where its targets are stands in `[[ranging]]`, and the direction of its axis A in
    /// `heading_offset_deg`.
    Rls,
    /// The front end of a camera: PINSD,TRK and PINSD,VO. How the camera sits stands in `[camera]`.
    Camera,
    /// A GNSS receiver of NMEA 2000: 129029, 129026, 129539, 129542, 126992, 129033.
    N2kGnss,
    /// A compass of NMEA 2000: 127250; 127257 if `yaw` is set.
    N2kHeading,
    /// A log of NMEA 2000: 130578, else 128259.
    N2kLog,
    /// A position of NMEA 2000 from elsewhere than the ship's receivers: 129025.
    N2kPosition,
    /// An IMU that sends plain CAN frames, by its `layout`.
    CanImu,
}

/// What a sensor measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// Rotation and specific force.
    Imu,
    /// Position and velocity by satellites.
    Gnss,
    /// Velocity over ground or through the water.
    Log,
    /// Heading.
    Heading,
    /// Roll and pitch alone.
    Attitude,
    /// Position.
    Position,
    /// Distances to lines and points ashore.
    Ranging,
    /// The other end of differences of satellites.
    Base,
    /// Points of the world in images.
    Camera,
}

impl Kind {
    /// What it measures.
    #[must_use]
    pub fn role(self) -> Role {
        match self {
            Kind::Sbg
            | Kind::Stdbin
            | Kind::Mip
            | Kind::Xbus
            | Kind::Kvh
            | Kind::Stim
            | Kind::Vectornav
            | Kind::NovatelImu
            | Kind::CanImu => Role::Imu,
            Kind::NmeaGnss
            | Kind::Ubx
            | Kind::Sbf
            | Kind::Gsof
            | Kind::Novatel
            | Kind::Rtcm
            | Kind::N2kGnss => Role::Gnss,
            Kind::NmeaLog
            | Kind::Pd0
            | Kind::Pd6
            | Kind::Nortek
            | Kind::Ad2cp
            | Kind::SignalkLog
            | Kind::N2kLog => Role::Log,
            Kind::Compass
            | Kind::Psxn
            | Kind::Pashr
            | Kind::Kmb
            | Kind::Em3000
            | Kind::StdbinIns
            | Kind::VectornavIns
            | Kind::Psat
            | Kind::Ptnl
            | Kind::Pfec
            | Kind::NovatelIns
            | Kind::SignalkHeading
            | Kind::N2kHeading => Role::Heading,
            Kind::Tss1 => Role::Attitude,
            Kind::NmeaPosition | Kind::SignalkPosition | Kind::Manual | Kind::N2kPosition => {
                Role::Position
            }
            Kind::Ranging | Kind::Rls => Role::Ranging,
            Kind::RtcmBase => Role::Base,
            Kind::Camera => Role::Camera,
        }
    }

    /// How its bytes are framed; `None` if it sends CAN frames, also where an adapter makes bytes of them.
    #[must_use]
    pub fn protocol(self) -> Option<Protocol> {
        Some(match self {
            Kind::Sbg => Protocol::Sbg,
            Kind::Stdbin | Kind::StdbinIns => Protocol::StdBin,
            Kind::Mip => Protocol::Mip,
            Kind::Xbus => Protocol::Xbus,
            Kind::Kvh => Protocol::Kvh,
            Kind::Stim => Protocol::Stim,
            Kind::Ubx => Protocol::Ubx,
            Kind::Sbf => Protocol::Sbf,
            Kind::Novatel | Kind::NovatelImu | Kind::NovatelIns => Protocol::Novatel,
            Kind::Vectornav | Kind::VectornavIns => Protocol::VectorNav,
            Kind::Gsof => Protocol::Gsof,
            Kind::Ad2cp => Protocol::Ad2cp,
            Kind::Kmb => Protocol::Kmb,
            Kind::Em3000 => Protocol::Em3000,
            Kind::Tss1 => Protocol::Tss1,
            Kind::Rtcm | Kind::RtcmBase => Protocol::Rtcm,
            Kind::Pd0 => Protocol::Pd0,
            Kind::Pd6 => Protocol::Pd6,
            Kind::SignalkHeading | Kind::SignalkLog | Kind::SignalkPosition => Protocol::SignalK,
            Kind::NmeaGnss
            | Kind::NmeaLog
            | Kind::Nortek
            | Kind::Compass
            | Kind::Psxn
            | Kind::Pashr
            | Kind::Psat
            | Kind::Ptnl
            | Kind::Pfec
            | Kind::NmeaPosition
            | Kind::Manual
            | Kind::Ranging
            | Kind::Camera
            | Kind::Rls => Protocol::Nmea,
            Kind::N2kGnss | Kind::N2kHeading | Kind::N2kLog | Kind::N2kPosition | Kind::CanImu => {
                return None;
            }
        })
    }

    /// Whether it is a device of NMEA 2000.
    #[must_use]
    pub fn is_n2k(self) -> bool {
        matches!(self, Kind::N2kGnss | Kind::N2kHeading | Kind::N2kLog | Kind::N2kPosition)
    }

    /// Whether a Signal K server tells it.
    #[must_use]
    pub fn is_signalk(self) -> bool {
        self.protocol() == Some(Protocol::SignalK)
    }
}
