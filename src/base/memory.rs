//! How much memory is available, and the refusal of runs that would need more.
//!
//! An allocation that fails ends the process, and one that Linux grants beyond its memory ends it later. So what a run
//! allocates is computed beforehand and compared with the machine's free memory, the limit of the process (`ulimit -v`,
//! RLIMIT_AS) and those of its control groups (containers, batch systems), the smallest of which counts.

use std::cell::Cell;
use std::fs;
use std::path::Path;

use crate::base::error::{Error, Result};
use crate::base::quantities::GIB;

/// Memory that a run may take where the system does not report its own \[bytes\].
const UNREPORTED: f64 = 8.0 * GIB;
/// Share of what there is that a run may set aside: the rest is for stacks, the solver and the caller.
const SHARE: f64 = 0.9;
/// Less than the stack of a thread: not worth asking the system, which takes as long as compiling a bearing \[bytes\].
const SMALL: f64 = 1e6;

/// Refuses to set aside more than there is; `what` says for what, and how to need less.
///
/// # Errors
/// [`Error::Memory`].
pub(crate) fn check(needed: f64, what: impl FnOnce() -> String) -> Result<()> {
    if needed <= SMALL.min(PART.get()) {
        return Ok(());
    }
    let available = available();
    if needed <= available {
        return Ok(());
    }
    Err(Error::Memory {
        needed,
        available,
        what: if PART.get().is_finite() {
            format!(
                "{}, or run fewer cases at once, which share the memory",
                what()
            )
        } else {
            what()
        },
    })
}

/// Memory that a run may set aside now \[bytes\].
pub fn available() -> f64 {
    let root = Path::new("/");
    let limits = [free(root), address_space(root), control_groups(root)];
    let least = limits.into_iter().flatten().fold(f64::INFINITY, f64::min);
    let all = if least.is_finite() {
        SHARE * least.max(0.0)
    } else {
        UNREPORTED
    };
    all.min(PART.get())
}

thread_local! {
    /// Share of the memory for the work of this thread \[bytes\].
    static PART: Cell<f64> = const { Cell::new(f64::INFINITY) };
}

/// Works on this thread with a part of what there is \[bytes\]: several runs at once would each count on all of it.
pub fn within<T>(part: f64, work: impl FnOnce() -> T) -> T {
    /// Gives back what there was before, after a panic too.
    struct PartBefore(f64);
    impl Drop for PartBefore {
        fn drop(&mut self) {
            PART.set(self.0);
        }
    }
    let _before = PartBefore(PART.replace(part));
    work()
}

/// Memory of the machine that can be had without swapping.
fn free(root: &Path) -> Option<f64> {
    kilobytes(&root.join("proc/meminfo"), "MemAvailable:")
}

/// Address space that RLIMIT_AS leaves.
fn address_space(root: &Path) -> Option<f64> {
    let limits = fs::read_to_string(root.join("proc/self/limits")).ok()?;
    let line = limits
        .lines()
        .find_map(|l| l.strip_prefix("Max address space"))?;
    let limit: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(limit - kilobytes(&root.join("proc/self/status"), "VmSize:")?)
}

/// Memory that the control groups of the process, versions 1 and 2, and those above them leave.
fn control_groups(root: &Path) -> Option<f64> {
    let groups = fs::read_to_string(root.join("proc/self/cgroup")).ok()?;
    let left = groups.lines().flat_map(|line| {
        let mut parts = line.splitn(3, ':').skip(1);
        let (controllers, path) = (parts.next().unwrap_or(""), parts.next().unwrap_or("/"));
        let files = if controllers.is_empty() {
            ("sys/fs/cgroup", "memory.max", "memory.current", "file")
        } else if controllers.split(',').any(|name| name == "memory") {
            (
                "sys/fs/cgroup/memory",
                "memory.limit_in_bytes",
                "memory.usage_in_bytes",
                "total_cache",
            )
        } else {
            return Vec::new();
        };
        let (mount, limit, usage, cache) = files;
        Path::new(path.trim_start_matches('/'))
            .ancestors()
            .filter_map(|group| group_left(&root.join(mount).join(group), limit, usage, cache))
            .collect()
    });
    left.reduce(f64::min)
}

/// A group's limit less what it uses; what caches files is given up on demand.
fn group_left(group: &Path, limit: &str, usage: &str, cache: &str) -> Option<f64> {
    let number = |file: &str| {
        fs::read_to_string(group.join(file))
            .ok()?
            .trim()
            .parse()
            .ok()
    };
    let (limit, usage): (f64, f64) = (number(limit)?, number(usage)?);
    let stat = fs::read_to_string(group.join("memory.stat")).unwrap_or_default();
    let cached = stat.lines().find_map(|line| {
        let (name, value) = line.split_once(' ')?;
        (name == cache).then(|| value.parse().ok())?
    });
    Some(limit - usage + cached.unwrap_or(0.0))
}

/// A line such as `VmSize:  1234 kB` \[bytes\].
fn kilobytes(file: &Path, name: &str) -> Option<f64> {
    let text = fs::read_to_string(file).ok()?;
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    let number: f64 = line.split_whitespace().next()?.parse().ok()?;
    Some(1024.0 * number)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file tree as Linux shows it.
    fn tree(name: &str, files: &[(&str, &str)]) -> std::path::PathBuf {
        let root = std::env::temp_dir().join(format!("ballrace-{}-{name}", std::process::id()));
        for (file, text) in files {
            let path = root.join(file);
            fs::create_dir_all(path.parent().unwrap()).unwrap();
            fs::write(path, text).unwrap();
        }
        root
    }

    #[test]
    fn the_smallest_group_above_a_process_counts() {
        let unified = tree(
            "v2",
            &[
                ("proc/self/cgroup", "0::/jobs/one\n"),
                ("sys/fs/cgroup/jobs/memory.max", "4000\n"),
                ("sys/fs/cgroup/jobs/memory.current", "3000\n"),
                ("sys/fs/cgroup/jobs/memory.stat", "anon 1000\nfile 500\n"),
                ("sys/fs/cgroup/jobs/one/memory.max", "max\n"),
                ("sys/fs/cgroup/jobs/one/memory.current", "100\n"),
            ],
        );
        let first = tree(
            "v1",
            &[
                ("proc/self/cgroup", "3:cpu:/x\n2:memory,hugetlb:/job\n"),
                ("sys/fs/cgroup/memory/job/memory.limit_in_bytes", "9000"),
                ("sys/fs/cgroup/memory/job/memory.usage_in_bytes", "2000"),
            ],
        );
        let found = (control_groups(&unified), control_groups(&first));
        fs::remove_dir_all(unified).unwrap();
        fs::remove_dir_all(first).unwrap();
        assert_eq!(found, (Some(1500.0), Some(7000.0)));
    }

    #[test]
    fn the_limit_of_the_address_space_is_what_is_left_of_it() {
        let line = |soft: &str| {
            format!("Limit  Soft  Hard\nMax address space  {soft}  unlimited  bytes\n")
        };
        let of = |name: &str, soft: &str| {
            let status = ("proc/self/status", "Name: x\nVmSize:\t    1 kB\n");
            let root = tree(name, &[("proc/self/limits", &line(soft)), status]);
            let found = address_space(&root);
            fs::remove_dir_all(root).unwrap();
            found
        };
        assert_eq!(of("limited", "5000"), Some(3976.0));
        assert_eq!(of("unlimited", "unlimited"), None);
    }

    #[test]
    fn a_part_holds_for_its_work() {
        assert_eq!(within(1e3, available), 1e3);
        assert!(within(1e3, || check(2e3, String::new)).is_err());
        assert!(check(2e3, String::new).is_ok());
    }

    #[test]
    fn too_much_is_refused_with_numbers() {
        assert_eq!(check(1.0, String::new), Ok(()));
        let error = check(1e30, || "a run; shorten it".to_owned()).unwrap_err();
        let text = error.to_string();
        assert!(
            text.ends_with("a run; shorten it") && text.contains("GiB"),
            "{text}"
        );
    }
}
