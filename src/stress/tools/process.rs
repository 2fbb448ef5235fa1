//! What memory the process has taken, as the system counts it.

/// Bytes that are resident now; none where the system does not tell.
#[cfg(any(target_os = "linux", target_os = "android"))]
pub fn resident() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmRSS:"))?;
    let kibibytes: u64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes * 1024)
}

#[cfg(not(any(target_os = "linux", target_os = "android")))]
pub fn resident() -> Option<u64> {
    None
}
