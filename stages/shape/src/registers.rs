//! Kernels run with the widest registers that the processor has.
//!
//! The one place with `unsafe` in the project: programs are built for every x86-64 processor, whose registers
//! hold four numbers, and nearly every one that is in use holds eight. The loops of a kernel are whole lanes of
//! eight in a fixed order and nothing is contracted, so that the bytes are the same either way.

/// Runs `work`, compiled for the widest registers that this processor has. What `work` calls is compiled so as far as it
/// is inlined: kernels are `#[inline(always)]`.
#[inline]
pub fn widest<R>(work: impl FnOnce() -> R) -> R {
    #[cfg(target_arch = "x86_64")]
    if std::arch::is_x86_feature_detected!("avx2") {
        // SAFETY: the processor has what `eight_wide` is compiled for; it was asked one line above.
        #[allow(unsafe_code)]
        return unsafe { eight_wide(work) };
    }
    work()
}

/// `work` in registers of eight numbers.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn eight_wide<R>(work: impl FnOnce() -> R) -> R {
    work()
}
