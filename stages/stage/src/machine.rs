//! What a machine offers beyond the language: the widest registers of its processor, and memory that goes back.
//!
//! The one file with `unsafe` in the project. Programs are built for every x86-64 processor, whose registers
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

/// What is at least so large goes back to the system once it is freed (structural: far larger than what a kernel makes
/// anew in its loops, an image of floats is as large; docs/lab/performance.md). \[bytes\]
#[cfg(all(target_os = "linux", target_env = "gnu"))]
const GOES_BACK_BYTES: i32 = 16 << 20;

/// From here on, large memory goes back to the system once it is freed. Otherwise glibc keeps more and more of it for
/// what may come: each time something large is freed, it counts what is smaller as small.
pub fn give_large_memory_back() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    for option in [libc::M_MMAP_THRESHOLD, libc::M_TRIM_THRESHOLD] {
        // SAFETY: it sets a number of the allocator, whatever was allocated before.
        #[allow(unsafe_code)]
        unsafe {
            libc::mallopt(option, GOES_BACK_BYTES)
        };
    }
}

/// Gives back to the system what was freed and is kept for what may come. It takes some milliseconds.
pub fn give_freed_memory_back() {
    #[cfg(all(target_os = "linux", target_env = "gnu"))]
    // SAFETY: it gives back pages that nothing uses, by the allocator's own account.
    #[allow(unsafe_code)]
    unsafe {
        libc::malloc_trim(0)
    };
}
