//! The three status words of a Phins.
//!
//! The bits are those of the INS Interface Library MU-INSIII-AN-001 (2014) as the open parsers of the
//! maker and of others have them (`ixblue_stdbin_decoder`, rock-drivers, `ds_msgs`). Where editions differ,
//! the younger one is named here and the older one said. Not verified against a device, but for the
//! published records that the tests read.

use crate::nmea::bits::status_word;

status_word! {
    /// STATUS: inputs, outputs, and which sensors are detected. The low half is sent first.
    PixseSystemStatus(u64) {
        INPUT_R_ERROR = 0, "errors on the repeater's input";
        INPUT_A_ERROR = 1, "errors on input A";
        INPUT_B_ERROR = 2, "errors on input B";
        INPUT_C_ERROR = 3, "errors on input C";
        INPUT_D_ERROR = 4, "errors on input D";
        INPUT_E_ERROR = 5, "errors on input E";
        INPUT_R_ACTIVE = 8, "the repeater's input receives";
        INPUT_A_ACTIVE = 9, "input A receives";
        INPUT_B_ACTIVE = 10, "input B receives";
        INPUT_C_ACTIVE = 11, "input C receives";
        INPUT_D_ACTIVE = 12, "input D receives";
        INPUT_E_ACTIVE = 13, "input E receives";
        OUTPUT_R_FULL = 16, "the repeater's output is overloaded";
        OUTPUT_A_FULL = 17, "output A is overloaded";
        OUTPUT_B_FULL = 18, "output B is overloaded";
        OUTPUT_C_FULL = 19, "output C is overloaded";
        OUTPUT_D_FULL = 20, "output D is overloaded";
        OUTPUT_E_FULL = 21, "output E is overloaded";
        ETHERNET_FULL = 22, "the network output is overloaded";
        ETHERNET_ACTIVE = 26, "the network input receives";
        PULSE_A_ACTIVE = 27, "pulse input A receives (older: user bit A)";
        PULSE_B_ACTIVE = 28, "pulse input B receives (older: user bit B)";
        BOTTOM_TRACK_DETECTED = 32, "a Doppler log tells the speed over ground";
        WATER_TRACK_DETECTED = 33, "a Doppler log tells the speed through the water";
        GPS1_DETECTED = 34, "GNSS 1 is detected";
        GPS2_DETECTED = 35, "GNSS 2 is detected";
        USBL_DETECTED = 36, "an acoustic position is detected";
        LBL_DETECTED = 37, "acoustic ranges are detected";
        DEPTH_DETECTED = 38, "a depth sensor is detected";
        EM_LOG_DETECTED = 39, "an electromagnetic log is detected";
        ODOMETER_DETECTED = 40, "an odometer is detected";
        UTC_DETECTED = 41, "UTC is detected";
        ALTITUDE_DETECTED = 42, "an altitude above the bottom is detected";
        PPS_DETECTED = 43, "a pulse per second is detected";
        ZERO_VELOCITY_MODE = 44, "updates of zero velocity are on";
        MANUAL_GPS_DETECTED = 46, "a position was set by hand";
        SOUND_VELOCITY_DETECTED = 47, "a CTD probe is detected";
        SIMULATION = 48, "simulation (older: heading, roll and pitch degraded)";
        ATTITUDE_INVALID = 49, "heading, roll and pitch not valid (older; reserved in the younger edition)";
        HEADING_ALERT = 51, "alert of the heading";
        POSITION_ALERT = 52, "alert of the position";
        WAITING_FOR_POSITION = 53, "waits for a position to start from";
        CPU_OVERLOAD = 59, "the processor is overloaded";
        POWER_FAILURE = 60, "the power supply fails (older: fault)";
        CONFIGURATION_SAVED = 62, "the configuration has been saved";
    }
}

status_word! {
    /// ALGSTS: what the filter does. The low half is sent first.
    PixseAlgorithmStatus(u64) {
        NAVIGATION = 0, "navigation";
        ALIGNMENT = 1, "alignment";
        FINE_ALIGNMENT = 2, "fine alignment";
        DEAD_RECKONING = 3, "dead reckoning";
        ALTITUDE_BY_GPS = 4, "the altitude is that of GNSS";
        ALTITUDE_BY_DEPTH = 5, "the altitude is that of the depth sensor";
        ALTITUDE_STABILISED = 6, "the altitude is held";
        ALTITUDE_HYDRO = 7, "the altitude is that of hydrography";
        LOG_RECEIVED = 8, "speed over ground is received";
        LOG_VALID = 9, "speed over ground is valid";
        LOG_WAITING = 10, "speed over ground is waited for";
        LOG_REJECTED = 11, "speed over ground is rejected";
        GPS1_RECEIVED = 12, "GNSS 1 is received";
        GPS1_VALID = 13, "GNSS 1 is valid";
        GPS1_WAITING = 14, "GNSS 1 is waited for";
        GPS1_REJECTED = 15, "GNSS 1 is rejected";
        USBL_RECEIVED = 16, "acoustic position is received";
        USBL_VALID = 17, "acoustic position is valid";
        USBL_WAITING = 18, "acoustic position is waited for";
        USBL_REJECTED = 19, "acoustic position is rejected";
        DEPTH_RECEIVED = 20, "depth is received";
        DEPTH_VALID = 21, "depth is valid";
        DEPTH_WAITING = 22, "depth is waited for";
        DEPTH_REJECTED = 23, "depth is rejected";
        LBL_RECEIVED = 24, "acoustic ranges are received";
        LBL_VALID = 25, "acoustic ranges are valid";
        LBL_WAITING = 26, "acoustic ranges are waited for";
        LBL_REJECTED = 27, "acoustic ranges are rejected";
        ALTITUDE_SATURATION = 28, "the altitude exceeds what may be told";
        SPEED_SATURATION = 29, "the speed exceeds what may be told";
        INTERPOLATION_MISSED = 30, "an interpolation was missed (older: reserved)";
        HEAVE_INITIALISATION = 31, "the heave is settling (older: reserved)";
        WATER_TRACK_RECEIVED = 32, "speed through the water is received";
        WATER_TRACK_VALID = 33, "speed through the water is valid";
        WATER_TRACK_WAITING = 34, "speed through the water is waited for";
        WATER_TRACK_REJECTED = 35, "speed through the water is rejected";
        GPS2_RECEIVED = 36, "GNSS 2 is received";
        GPS2_VALID = 37, "GNSS 2 is valid";
        GPS2_WAITING = 38, "GNSS 2 is waited for";
        GPS2_REJECTED = 39, "GNSS 2 is rejected";
        ALTITUDE_RECEIVED = 44, "altitude above the bottom is received";
        ALTITUDE_VALID = 45, "altitude above the bottom is valid";
        ALTITUDE_WAITING = 46, "altitude above the bottom is waited for";
        ALTITUDE_REJECTED = 47, "altitude above the bottom is rejected";
        ZERO_VELOCITY_MODE = 48, "updates of zero velocity are on";
        ZERO_VELOCITY_VALID = 49, "updates of zero velocity are valid";
        BENCH_MODE = 50, "updates of zero velocity when at rest are on";
        BENCH_VALID = 51, "updates of zero velocity when at rest are valid";
        STATIC_ALIGNMENT = 52, "alignment at rest";
        GO_TO_NAVIGATION = 53, "alignment at rest goes over to navigation";
        FAST_ALIGNMENT = 54, "fast alignment (older: reserved)";
        EMULATION = 55, "emulation (older: reserved)";
        EM_LOG_RECEIVED = 56, "the electromagnetic log is received";
        EM_LOG_VALID = 57, "the electromagnetic log is valid";
        EM_LOG_WAITING = 58, "the electromagnetic log is waited for";
        EM_LOG_REJECTED = 59, "the electromagnetic log is rejected";
        MANUAL_GPS_RECEIVED = 60, "a position set by hand is received";
        MANUAL_GPS_VALID = 61, "a position set by hand is valid";
        MANUAL_GPS_WAITING = 62, "a position set by hand is waited for";
        MANUAL_GPS_REJECTED = 63, "a position set by hand is rejected";
    }
}

status_word! {
    /// HT_STS: how the unit is, in pairs of bits for good and bad, and which sensors are missing.
    ///
    /// `ds_msgs` calls bit 31 "zero velocity mode activated", but in the published records it is set in
    /// those units whose STATUS says that the mode is off, and not in those where it is on: like the bits
    /// before it, it says what is not.
    PixseHighLevelStatus(u32) {
        GOOD = 0, "the unit works";
        ALIGNING = 1, "alignment";
        ERROR = 2, "error";
        WARNING = 3, "warning";
        INPUTS_GOOD = 4, "the inputs are good";
        INPUTS_BAD = 5, "errors on an input";
        OUTPUTS_GOOD = 6, "the outputs are good";
        OUTPUTS_BAD = 7, "errors on an output";
        ELECTRONICS_GOOD = 8, "the electronics are good";
        ELECTRONICS_BAD = 9, "the electronics are faulty";
        GYROS_GOOD = 10, "the gyros are good";
        GYROS_BAD = 11, "a gyro is faulty";
        ACCELEROMETERS_GOOD = 12, "the accelerometers are good";
        ACCELEROMETERS_BAD = 13, "an accelerometer is faulty";
        CPU_GOOD = 14, "the processor is good";
        CPU_BAD = 15, "the processor is faulty";
        TEMPERATURE_GOOD = 16, "the temperature is good";
        TEMPERATURE_BAD = 17, "the temperature is out of range";
        NO_GPS1 = 18, "no GNSS 1";
        NO_GPS2 = 19, "no GNSS 2";
        NO_MANUAL_GPS = 20, "no position set by hand";
        NO_BOTTOM_TRACK = 21, "no speed over ground of a log";
        NO_WATER_TRACK = 22, "no speed through the water of a Doppler log";
        NO_EM_LOG = 23, "no electromagnetic log";
        NO_DEPTH = 24, "no depth sensor";
        NO_USBL = 25, "no acoustic position";
        NO_LBL = 26, "no acoustic ranges";
        NO_ALTITUDE = 27, "no altitude above the bottom";
        NO_UTC = 28, "no UTC";
        NO_PPS = 29, "no pulse per second";
        NO_SOUND_VELOCITY = 30, "no CTD probe";
        NO_ZERO_VELOCITY_MODE = 31, "updates of zero velocity are off (see above)";
    }
}
