//! PHINF: status word of Octans, Phins and the units that speak like them.
//!
//! The word has one of two tables of bits, and nothing in the sentence tells which: an Octans (an AHRS),
//! and SBG Systems when it speaks like one, send [`OctansStatus`]; a Phins (an INS) sends its user
//! status, [`InsUserStatus`]. Bit 27 is "an angle is invalid" in one and "alignment" in the other.
//!
//! Octans: from the manual of the Reson SeaBat 8101 and, for the bits that this does not name, SBG
//! Systems `nmeaMessages.md`. Phins: from the maker's open decoder of its binary telegrams, which has the
//! same word (`ixblue_stdbin_decoder`). Records of Phins units (`20000000`, `30000102`) make sense by the
//! second table only.

use super::bits::status_word;
use super::kinds::Field;
use super::parts::{word, word_of};
use super::table::sentence;

status_word! {
    /// Status of an Octans, as SBG Systems gives it, too.
    OctansStatus(u32) {
        HEADING_INVALID = 0, "heading is invalid or still converging";
        ROLL_INVALID = 1, "roll is invalid or still converging";
        PITCH_INVALID = 2, "pitch is invalid or still converging";
        HEAVE_INITIALISATION = 3, "heave, surge and sway are settling";
        POSITION_STARTING = 4, "the calculation of the position starts (Octans; reserved with SBG)";
        ALIGNMENT = 5, "alignment";
        CONFIGURATION_SAVED = 6, "the configuration has been saved";
        CPU_OVERLOAD = 7, "the processor is overloaded";
        GYRO_X_ERROR = 8, "gyro X is faulty";
        GYRO_Y_ERROR = 9, "gyro Y is faulty";
        GYRO_Z_ERROR = 10, "gyro Z is faulty";
        GYRO_RANGE = 11, "a gyro is out of range (SBG), or the optical source is faulty (Octans)";
        ACCELEROMETER_X_ERROR = 12, "accelerometer X is faulty";
        ACCELEROMETER_Y_ERROR = 13, "accelerometer Y is faulty";
        ACCELEROMETER_Z_ERROR = 14, "accelerometer Z is faulty";
        SENSOR_ERROR = 15, "a sensor fails (SBG), or an analog input is in error (Octans)";
        INPUT_A_ERROR = 16, "errors on serial input A";
        INPUT_B_ERROR = 17, "errors on serial input B";
        INPUT_C_ERROR = 18, "errors on serial input C";
        OUTPUT_OVERLOAD = 19, "a serial output is overloaded";
        OUTPUT_A_FULL = 20, "serial output A is overloaded";
        OUTPUT_B_FULL = 21, "serial output B is overloaded";
        OUTPUT_C_FULL = 22, "serial output C is overloaded";
        OUTPUT_D_FULL = 23, "serial output D is overloaded";
        MANUAL_SPEED = 24, "a speed set by hand is in use";
        MANUAL_LATITUDE = 25, "a latitude set by hand is in use";
        ATTITUDE_INVALID = 27, "at least one of heading, roll and pitch is invalid";
        RESTARTED = 31, "the unit has started again";
    }
}

status_word! {
    /// User status of a Phins, and of the other INS of its maker.
    InsUserStatus(u32) {
        DVL_VALID = 0, "a Doppler log is received and valid";
        GPS1_VALID = 1, "GNSS 1 is received and valid";
        DEPTH_VALID = 2, "a depth is received and valid";
        USBL_VALID = 3, "an acoustic position is received and valid";
        LBL_VALID = 4, "acoustic ranges are received and valid";
        GPS2_VALID = 5, "GNSS 2 is received and valid";
        EM_LOG_VALID = 6, "an electromagnetic log is received and valid";
        MANUAL_GPS_VALID = 7, "a position set by hand is received and valid";
        TIME_VALID = 8, "time is received and valid";
        GYRO_ANOMALY = 9, "a gyro is faulty";
        ACCELEROMETER_ANOMALY = 10, "an accelerometer is faulty";
        TEMPERATURE_ERROR = 11, "the temperature is out of range";
        CPU_OVERLOAD = 12, "the processor is overloaded";
        DYNAMICS_EXCEEDED = 13, "the motion exceeds what is measured";
        SPEED_SATURATION = 14, "the speed exceeds what may be told";
        ALTITUDE_SATURATION = 15, "the altitude exceeds what may be told";
        INPUT_A_ERROR = 16, "errors on input A";
        INPUT_B_ERROR = 17, "errors on input B";
        INPUT_C_ERROR = 18, "errors on input C";
        INPUT_D_ERROR = 19, "errors on input D";
        INPUT_E_ERROR = 20, "errors on input E";
        OUTPUT_A_ERROR = 21, "output A is full";
        OUTPUT_B_ERROR = 22, "output B is full";
        OUTPUT_C_ERROR = 23, "output C is full";
        OUTPUT_D_ERROR = 24, "output D is full";
        OUTPUT_E_ERROR = 25, "output E is full";
        ATTITUDE_INVALID = 26, "heading, roll and pitch are invalid";
        ALIGNMENT = 27, "alignment";
        FINE_ALIGNMENT = 28, "fine alignment";
        NAVIGATION = 29, "navigation";
        DEGRADED = 30, "degraded mode";
        FAILURE = 31, "failure";
    }
}

const WORD: Field<u32> = Field { write: |line, bits| word(line, Some(bits)), read: word_of };

sentence! {
    /// A status word as it was sent, before someone says whose it is.
    own Phinf "PHINF", longest 20: Default Eq;
    /// The word, eight hexadecimal digits; see [`Phinf::octans`] and [`Phinf::ins`].
    1 word: Option<u32> = WORD;
}

impl Phinf {
    /// The sentence of a unit that is taken for an Octans.
    #[must_use]
    pub fn of_octans(status: OctansStatus) -> Self {
        Phinf { word: Some(status.0) }
    }

    /// The sentence of a unit that is taken for a Phins.
    #[must_use]
    pub fn of_ins(status: InsUserStatus) -> Self {
        Phinf { word: Some(status.0) }
    }

    /// What the word says if an Octans sent it.
    #[must_use]
    pub fn octans(&self) -> Option<OctansStatus> {
        self.word.map(OctansStatus)
    }

    /// What the word says if a Phins sent it.
    #[must_use]
    pub fn ins(&self) -> Option<InsUserStatus> {
        self.word.map(InsUserStatus)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_is_made_of_its_bits_and_names_them() {
        let heading = OctansStatus::HEADING_INVALID;
        let restarted = OctansStatus::RESTARTED;
        let word = OctansStatus::default().with(heading, true).with(restarted, false);
        assert!(word.has(heading) && !word.has(restarted));
        let both = heading | restarted;
        assert_eq!(both.0, 0x8000_0001);
        assert!(both.has(word) && !word.has(both));
        let text = "OctansStatus(80000001 HEADING_INVALID RESTARTED)";
        assert_eq!(format!("{both:?}"), text);
    }
}
