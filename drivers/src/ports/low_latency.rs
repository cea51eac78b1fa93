//! Asking a serial driver to hand over bytes at once.
//!
//! Two ways: the flag `ASYNC_LOW_LATENCY` of `TIOCSSERIAL` (`linux/serial.h`, `linux/tty_flags.h`), and
//! the latency timer of FTDI converters, which hold bytes for 16 ms unless told otherwise and of which
//! some drivers heed only the file in sysfs (`drivers/usb/serial/ftdi_sio.c`).

use std::ffi::{c_int, c_uint, c_ulong};
use std::os::fd::AsFd;
use std::path::Path;

use rustix::io::Errno;
use rustix::ioctl::{Getter, Opcode, Setter, ioctl};

const TIOCGSERIAL: Opcode = 0x541e;
const TIOCSSERIAL: Opcode = 0x541f;
const ASYNC_LOW_LATENCY: c_int = 1 << 13;

/// `struct serial_struct` of `linux/serial.h`.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
struct SerialStruct {
    kind: c_int,
    line: c_int,
    port: c_uint,
    irq: c_int,
    flags: c_int,
    xmit_fifo_size: c_int,
    custom_divisor: c_int,
    baud_base: c_int,
    close_delay: u16,
    io_type: u8,
    reserved: u8,
    hub6: c_int,
    closing_wait: u16,
    closing_wait2: u16,
    /// A pointer of the kernel's that is only handed back.
    iomem_base: usize,
    iomem_reg_shift: u16,
    port_high: c_uint,
    iomap_base: c_ulong,
}

/// Sets the flag of an open serial port.
///
/// # Errors
/// `NOTTY` or `INVAL` when the driver has no such thing, `PERM` when it may not be set.
#[expect(unsafe_code, reason = "the kernel's structure is not in the libraries")]
pub(super) fn set(port: impl AsFd) -> Result<(), Errno> {
    // Sound: both codes belong to `SerialStruct`, which is laid out as the kernel's `serial_struct`
    // (72 bytes on 64-bit machines, the test below); the kernel fills it wholly or fails, any bits are
    // valid values of its fields, and setting it reads from it and keeps no pointer.
    unsafe {
        let mut settings: SerialStruct = ioctl(&port, Getter::<TIOCGSERIAL, _>::new())?;
        if settings.flags & ASYNC_LOW_LATENCY != 0 {
            return Ok(());
        }
        settings.flags |= ASYNC_LOW_LATENCY;
        ioctl(&port, Setter::<TIOCSSERIAL, _>::new(settings))
    }
}

/// Sets the latency timer of an FTDI converter to 1 ms; true if there was one to set. `root` is the
/// root of the file system.
pub(super) fn set_ftdi_timer(root: &Path, device: &Path) -> bool {
    let real = device.canonicalize().unwrap_or_else(|_| device.to_owned());
    let Some(name) = real.file_name() else { return false };
    let timer = root.join("sys/class/tty").join(name).join("device/latency_timer");
    timer.exists() && std::fs::write(timer, "1").is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rustix::pty::{OpenptFlags, openpt};

    #[test]
    #[cfg(target_pointer_width = "64")]
    fn the_structure_is_as_long_as_the_kernels() {
        assert_eq!(size_of::<SerialStruct>(), 72);
        assert_eq!(std::mem::offset_of!(SerialStruct, iomem_base), 48);
        assert_eq!(std::mem::offset_of!(SerialStruct, iomap_base), 64);
    }

    #[test]
    fn a_terminal_without_hardware_says_that_it_has_no_such_flag() {
        let pty = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY).unwrap();
        assert!(matches!(set(&pty), Err(Errno::NOTTY | Errno::INVAL)));
    }

    #[test]
    fn the_timer_of_a_converter_is_set() {
        let root = tempfile::tempdir().unwrap();
        let folder = root.path().join("sys/class/tty/ttyUSB7/device");
        std::fs::create_dir_all(&folder).unwrap();
        std::fs::write(folder.join("latency_timer"), "16").unwrap();
        assert!(set_ftdi_timer(root.path(), Path::new("/dev/ttyUSB7")));
        assert_eq!(std::fs::read_to_string(folder.join("latency_timer")).unwrap(), "1");
        assert!(!set_ftdi_timer(root.path(), Path::new("/dev/ttyUSB8")));
    }
}
