//! Work that somebody on board waits for less than for anything else.

use thread_priority::{
    NormalThreadSchedulePolicy, ThreadPriority, ThreadSchedulePolicy,
    set_thread_priority_and_policy, thread_native_id,
};

/// What the kernel ends first when memory is short.
const FIRST_TO_GO: &str = "1000";

/// Runs when nobody else wants the processor (`SCHED_IDLE`; threads that begin later do, too), and goes first when memory is
/// short. Where the system grants neither it is as any other program, which harms nobody.
pub(crate) fn give_way() {
    let policy = ThreadSchedulePolicy::Normal(NormalThreadSchedulePolicy::Idle);
    let lowered = set_thread_priority_and_policy(thread_native_id(), ThreadPriority::Min, policy)
        .map_err(|fault| format!("{fault:?}"));
    if let Err(fault) = lowered {
        tracing::debug!(fault, "no idle priority");
    }
    if let Err(fault) = std::fs::write("/proc/self/oom_score_adj", FIRST_TO_GO) {
        tracing::debug!(%fault, "not the first to go when memory is short");
    }
}
