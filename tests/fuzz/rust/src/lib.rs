//! What the fuzz targets share: scenes to begin with, how they are changed, and what must hold of what becomes of them.

pub mod bases;
pub mod changes;
pub mod check;
pub mod seeds;
pub mod short;
pub mod sweep;

/// Address space that a target may take beyond what it has when it begins \[bytes\].
const MEMORY: u64 = 1 << 30;

/// Prepares a target: writes its seeds, and leaves the process little memory, so that estimates that are too low end it.
pub fn begin(target: &str) {
    seeds::write(target);
    let _ = bases::all();
    #[cfg(target_os = "linux")]
    {
        let pages = std::fs::read_to_string("/proc/self/statm").unwrap_or_default();
        let used: u64 = pages
            .split(' ')
            .next()
            .and_then(|n| n.parse().ok())
            .unwrap_or(0);
        let limit = used * 4096 + MEMORY;
        rlimit::Resource::AS
            .set(limit, limit)
            .expect("a limit of the address space");
    }
}
