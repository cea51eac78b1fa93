//! Images of cameras: a folder of pictures with times, the pipe of a child process, V4L2; and pictures drawn over.
//!
//! A camera that lives has a thread of its own ([`LiveCamera`]): one that hangs delays nobody, and what finds no room is dropped and counted.

mod child;
mod device;
mod fault;
mod folder;
mod image_file;
mod live;
mod one_core;
mod sketch;

pub use child::{PipedSource, start_child};
pub use device::start_device;
pub use fault::CaptureFault;
pub use folder::{ImageFolder, TimedImage};
pub use image_file::{GreyImage, read_image};
pub use live::LiveCamera;
pub use one_core::on_one_core;
pub use sketch::Sketch;
