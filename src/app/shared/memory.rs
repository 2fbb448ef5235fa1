//! What memory the process has taken at most, as the system counts it.

/// Bytes that were resident at once, at most; none where the system does not tell.
pub fn peak() -> Option<u64> {
    resident_peak().filter(|bytes| *bytes > 0)
}

/// Bytes as users read them.
pub fn shown(bytes: u64) -> String {
    match bytes {
        0..1024 => format!("{bytes} bytes"),
        1024..1_048_576 => format!("{:.1} KiB", bytes as f64 / 1024.0),
        1_048_576..1_073_741_824 => format!("{:.1} MiB", bytes as f64 / 1_048_576.0),
        _ => format!("{:.2} GiB", bytes as f64 / 1_073_741_824.0),
    }
}

/// The high-water mark of this program: what `getrusage` says may be of the process that started it.
#[cfg(any(target_os = "linux", target_os = "android"))]
fn resident_peak() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
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
