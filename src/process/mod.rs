//! What memory the process has taken, as the system counts it. Knows nothing of who asks.

/// Bytes that are resident now; none where the system does not tell. What was freed is given back to the system first, so that it doesn't count.
#[cfg(any(target_os = "linux", target_os = "android"))]
pub fn resident() -> Option<u64> {
    trim();
    status("VmRSS:")
}

/// Has the allocator give back what was freed: glibc's holds on to it, the more the more threads there were.
#[cfg(all(target_os = "linux", target_env = "gnu"))]
fn trim() {
    // SAFETY: it touches nothing but what the allocator itself has.
    unsafe { libc::malloc_trim(0) };
}

#[cfg(all(any(target_os = "linux", target_os = "android"), not(target_env = "gnu")))]
fn trim() {}

#[cfg(not(any(target_os = "linux", target_os = "android")))]
pub fn resident() -> Option<u64> {
    None
}

/// Bytes that were resident at once, at most; none where the system does not tell.
pub fn peak() -> Option<u64> {
    resident_peak().filter(|bytes| *bytes > 0)
}

/// The high-water mark of this program: what `getrusage` says may be of the process that started it.
#[cfg(any(target_os = "linux", target_os = "android"))]
fn resident_peak() -> Option<u64> {
    status("VmHWM:")
}

/// Bytes that the kernel tells of this process, by the name of their line.
#[cfg(any(target_os = "linux", target_os = "android"))]
fn status(name: &str) -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(name))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024)
}

#[cfg(target_vendor = "apple")]
fn resident_peak() -> Option<u64> {
    let mut usage = std::mem::MaybeUninit::<libc::rusage>::zeroed();
    // SAFETY: the call writes one `rusage` where it is told; zeros are one too.
    let usage = unsafe {
        let failed = libc::getrusage(libc::RUSAGE_SELF, usage.as_mut_ptr()) != 0;
        if failed {
            return None;
        }
        usage.assume_init()
    };
    // In bytes here; other systems have kibibytes.
    u64::try_from(usage.ru_maxrss).ok()
}

#[cfg(windows)]
fn resident_peak() -> Option<u64> {
    use windows_sys::Win32::System::ProcessStatus::{GetProcessMemoryInfo, PROCESS_MEMORY_COUNTERS};
    use windows_sys::Win32::System::Threading::GetCurrentProcess;
    let mut counters = PROCESS_MEMORY_COUNTERS::default();
    let size = size_of::<PROCESS_MEMORY_COUNTERS>() as u32;
    // SAFETY: the call writes as many bytes as it is told that there are.
    let told = unsafe { GetProcessMemoryInfo(GetCurrentProcess(), &mut counters, size) };
    (told != 0).then_some(counters.PeakWorkingSetSize as u64)
}

#[cfg(not(any(target_os = "linux", target_os = "android", target_vendor = "apple", windows)))]
fn resident_peak() -> Option<u64> {
    None
}
