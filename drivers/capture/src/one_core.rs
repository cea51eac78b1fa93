//! Work that has many threads at its hands, held to one.

use rayon::ThreadPoolBuilder;

/// Does `work` with a pool of one thread: the flow of points would take every core there is, and the navigation wants one of them.
pub fn on_one_core<R: Send>(work: impl FnOnce() -> R + Send) -> R {
    match ThreadPoolBuilder::new().num_threads(1).build() {
        Ok(pool) => pool.install(work),
        // no thread to be had: then the pool that all share does it
        Err(_) => work(),
    }
}
