//! Threads that go before others: what is due must leave in time on a busy computer.

use thread_priority::{
    RealtimeThreadSchedulePolicy, ThreadPriority, ThreadSchedulePolicy,
    set_thread_priority_and_policy, thread_native_id,
};

/// Lets this thread go before all that have no real-time priority, and before those of a lower one
/// (`SCHED_FIFO`, 1 to 99). Needs `CAP_SYS_NICE` or a limit that allows it (`LimitRTPRIO` of a unit).
pub(super) fn raise(priority: u8) -> Result<(), String> {
    let value = ThreadPriority::Crossplatform(priority.try_into()?);
    let policy = ThreadSchedulePolicy::Realtime(RealtimeThreadSchedulePolicy::Fifo);
    set_thread_priority_and_policy(thread_native_id(), value, policy)
        .map_err(|fault| format!("{fault:?}"))
}
