//! Starting, watching and stopping the process that meshes.

use crate::counts::Counters;
use crate::ffi::{self, tetgen_shim_start};
use crate::silence::Silence;
use crate::{Complex, Error, Failure, Limits, Mesh, News, SizeNode};
use std::ffi::CString;
use std::fs::File;
use std::io::{ErrorKind, PipeReader, Read};
use std::os::fd::{AsRawFd, FromRawFd};
use std::time::Instant;

/// Signals that a process gets for what it does itself.
const CRASHES: [i32; 7] = [
    libc::SIGSEGV,
    libc::SIGABRT,
    libc::SIGBUS,
    libc::SIGFPE,
    libc::SIGILL,
    libc::SIGTRAP,
    libc::SIGSYS,
];

/// A running mesher process. It is stopped when this value is dropped, and by the kernel when our
/// process ends.
#[derive(Debug)]
pub struct Child {
    pid: libc::pid_t,
    reaped: bool,
    started: Instant,
    result: File,
    chatter: PipeReader,
    switches: String,
    limits: Limits,
    counters: Option<Counters>,
}

impl Child {
    /// Starts TetGen on a complex. The thread that calls this must outlive the child: the kernel ties the child to it.
    ///
    /// # Errors
    /// [`Error::Unfit`], [`Error::BadSwitches`] (a NUL in the switches) and [`Error::System`].
    pub fn start(complex: &Complex<'_>, switches: &str, limits: Limits) -> Result<Self, Error> {
        let text = CString::new(switches).map_err(|_| Error::BadSwitches(switches.to_owned()))?;
        check(complex)?;
        let count = |n: usize, what: &str| {
            i32::try_from(n).map_err(|_| Error::Unfit(format!("{n} {what} are too many")))
        };
        let sizes = complex.sizes.as_ref();
        let is_counted = limits.counted_every.is_some() || limits.silence.is_some();
        let counters = is_counted.then(Counters::new).transpose()?;
        let input = ffi::Input {
            switches: text.as_ptr(),
            points: complex.points.as_ptr().cast(),
            triangles: complex.triangles.as_ptr().cast(),
            markers: complex.markers.as_ptr(),
            holes: complex.holes.as_ptr().cast(),
            regions: complex.regions.as_ptr().cast(),
            point_count: count(complex.points.len(), "points")?,
            triangle_count: count(complex.triangles.len(), "triangles")?,
            hole_count: count(complex.holes.len(), "holes")?,
            region_count: count(complex.regions.len(), "regions")?,
            memory: limits.memory.map_or(0, |bytes| bytes.max(1)),
            counts: counters.as_ref().map_or(std::ptr::null(), Counters::as_ptr),
            size_nodes: sizes.map_or(std::ptr::null(), |sizes| sizes.nodes.as_ptr()),
            size_origin: sizes.map_or([0.0; 3], |sizes| sizes.origin),
            size_width: sizes.map_or(1.0, |sizes| sizes.width),
            size_volume: sizes.map_or(0.0, |sizes| sizes.volume),
        };
        let result = memory_file()?;
        let (chatter, printing) = std::io::pipe().map_err(|error| Error::System {
            what: "opening a pipe",
            error,
        })?;
        let started = Instant::now();
        // SAFETY: all pointers are valid for the counts given, for the whole call; the child works
        // on its own copy of this memory. It runs no Rust code, and glibc makes its allocator and
        // its streams usable after a fork of a process with several threads.
        let pid = unsafe {
            tetgen_shim_start(&raw const input, result.as_raw_fd(), printing.as_raw_fd())
        };
        if pid < 0 {
            return Err(Error::system("starting a process"));
        }
        Ok(Self {
            pid,
            reaped: false,
            started,
            result,
            chatter,
            switches: switches.to_owned(),
            limits,
            counters,
        })
    }

    /// Process id.
    pub fn id(&self) -> u32 {
        self.pid as u32
    }

    /// Waits for the end, and tells the listener what TetGen does meanwhile.
    ///
    /// # Errors
    /// Everything that can happen to TetGen; see [`Error`].
    pub fn finish(mut self, listener: &mut dyn FnMut(News<'_>)) -> Result<Mesh, Error> {
        let timeout = self.limits.timeout;
        let deadline = timeout.and_then(|limit| self.started.checked_add(limit));
        let mut buffer = [0; 4096];
        let mut next_count = self.next_count();
        let silence = self.limits.silence;
        let mut silence = silence.map(|most| Silence::new(self.pid, most));
        // The pipe ends when the child does: nobody else holds its other end for long.
        loop {
            let next_look = silence.as_ref().and_then(Silence::next_look);
            let until = [deadline, next_count, next_look];
            let until = until.into_iter().flatten().min();
            let readable = self.readable(until)?;
            let now = Instant::now();
            if !readable && deadline.is_some_and(|end| end <= now) {
                return Err(Error::TimedOut(timeout.unwrap_or_default()));
            }
            if let Some(counters) = &self.counters
                && next_count.is_some_and(|next| next <= now)
            {
                listener(News::Counted(counters.read()));
                next_count = self.next_count();
            }
            if !readable {
                let checked = || self.counters.as_ref().map_or(0, |now| now.read().checked);
                match silence.as_mut().and_then(|s| s.broken(checked())) {
                    Some(most) => return Err(Error::Silent(most)),
                    None => continue,
                }
            }
            match self.chatter.read(&mut buffer) {
                Ok(0) => break,
                Ok(n) => {
                    if let Some(silence) = &mut silence {
                        silence.heard(&buffer[..n]);
                    }
                    listener(News::Printed(&buffer[..n]));
                }
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                Err(error) => {
                    return Err(Error::System {
                        what: "reading from the mesher",
                        error,
                    });
                }
            }
        }
        let status = self.wait()?;
        if let Some(counters) = self.counters.as_ref().filter(|_| next_count.is_some()) {
            listener(News::Counted(counters.read()));
        }
        self.outcome(status)
    }

    /// When the listener is to be told the next count.
    fn next_count(&self) -> Option<Instant> {
        Instant::now().checked_add(self.limits.counted_every?)
    }

    fn outcome(&self, status: i32) -> Result<Mesh, Error> {
        if libc::WIFSIGNALED(status) {
            return Err(match libc::WTERMSIG(status) {
                libc::SIGKILL => Error::Killed,
                signal if CRASHES.contains(&signal) => Error::Crashed { signal },
                signal => Error::Stopped { signal },
            });
        }
        let exit = libc::WEXITSTATUS(status);
        if exit == ffi::CANNOT_BEGIN {
            return Err(Error::System {
                what: "preparing the mesher's process",
                error: ErrorKind::Other.into(),
            });
        }
        if exit == ffi::OUT_OF_MEMORY {
            let failed = Error::Failed(Failure::OutOfMemory);
            return Err(self.limits.memory.map_or(failed, Error::MemoryLimit));
        }
        match Mesh::new(&self.result)? {
            Some((mesh, 0)) if exit == 0 => Ok(mesh),
            Some((_, code)) if exit == 0 => Err(match code {
                ffi::BAD_SWITCHES => Error::BadSwitches(self.switches.clone()),
                ffi::NOT_LINEAR => Error::NotLinear(self.switches.clone()),
                ffi::ENDED => Error::Exited { status: exit },
                ffi::NO_SPACE => Error::Failed(Failure::OutOfMemory),
                ffi::UNKNOWN_EXCEPTION => Error::Failed(Failure::Internal),
                thrown => match (Failure::from_code(thrown), self.limits.memory) {
                    (Failure::OutOfMemory, Some(limit)) => Error::MemoryLimit(limit),
                    (failure, _) => Error::Failed(failure),
                },
            }),
            _ => Err(Error::Exited { status: exit }),
        }
    }

    /// Waits until there is something to read or the pipe has ended; false when a moment came first.
    fn readable(&self, until: Option<Instant>) -> Result<bool, Error> {
        loop {
            let wait = match until {
                None => -1,
                Some(until) => {
                    let left = until.saturating_duration_since(Instant::now());
                    if left.is_zero() {
                        return Ok(false);
                    }
                    // Rounded up, so that the loop does not spin through the last millisecond.
                    i32::try_from(left.as_millis().saturating_add(1)).unwrap_or(i32::MAX)
                }
            };
            let mut poll = libc::pollfd {
                fd: self.chatter.as_raw_fd(),
                events: libc::POLLIN,
                revents: 0,
            };
            // SAFETY: one valid pollfd.
            match unsafe { libc::poll(&raw mut poll, 1, wait) } {
                0 => {}
                n if n > 0 => return Ok(true),
                _ => {
                    let error = std::io::Error::last_os_error();
                    if error.kind() != ErrorKind::Interrupted {
                        return Err(Error::System {
                            what: "waiting for the mesher",
                            error,
                        });
                    }
                }
            }
        }
    }

    /// The wait status of a child that has closed its output, which its end does.
    fn wait(&mut self) -> Result<i32, Error> {
        let mut status = 0;
        loop {
            // SAFETY: waits for our own child only, into a valid integer.
            let found = unsafe { libc::waitpid(self.pid, &raw mut status, 0) };
            if found == self.pid {
                self.reaped = true;
                return Ok(status);
            }
            let error = std::io::Error::last_os_error();
            if error.kind() != ErrorKind::Interrupted {
                // Somebody else has collected it.
                self.reaped = true;
                return Err(Error::System {
                    what: "waiting for the mesher",
                    error,
                });
            }
        }
    }
}

impl Drop for Child {
    fn drop(&mut self) {
        if self.reaped {
            return;
        }
        let mut status = 0;
        // SAFETY: the process is our child and not yet collected, so the id is still its own.
        unsafe {
            libc::kill(self.pid, libc::SIGKILL);
            while libc::waitpid(self.pid, &raw mut status, 0) < 0
                && std::io::Error::last_os_error().kind() == ErrorKind::Interrupted
            {}
        }
    }
}

/// Checks what TetGen itself would not: it reads out of bounds instead.
fn check(complex: &Complex<'_>) -> Result<(), Error> {
    let points = complex.points.len();
    if points < 4 || complex.triangles.len() < 4 {
        return Err(Error::Unfit(format!(
            "{points} points and {} triangles enclose nothing",
            complex.triangles.len()
        )));
    }
    if complex.markers.len() != complex.triangles.len() {
        return Err(Error::Unfit(format!(
            "{} triangles have {} markers",
            complex.triangles.len(),
            complex.markers.len()
        )));
    }
    let nodes = complex.sizes.map_or(&[][..], |sizes| sizes.nodes);
    let is_odd = |&(i, node): &(usize, &SizeNode)| {
        let first = node.first as usize;
        // Children lie behind their node, so that the way down ends.
        first != 0 && (first <= i || first.saturating_add(8) > nodes.len())
    };
    if let Some((i, node)) = nodes.iter().enumerate().find(is_odd) {
        return Err(Error::Unfit(format!(
            "node {i} of {} has children from {} on",
            nodes.len(),
            node.first
        )));
    }
    if complex.sizes.is_some() && nodes.is_empty() {
        return Err(Error::Unfit("an octree without nodes".to_owned()));
    }
    let seeds = complex.regions.iter().map(|r| &r.point);
    let positions = complex.points.iter().chain(complex.holes).chain(seeds);
    if let Some(p) = positions.flatten().find(|x| !x.is_finite()) {
        return Err(Error::Unfit(format!("a coordinate is {p}")));
    }
    for (i, t) in complex.triangles.iter().enumerate() {
        let inside = |v: i32| v >= 0 && (v as usize) < points;
        if !t.iter().all(|&v| inside(v)) || t[0] == t[1] || t[1] == t[2] || t[0] == t[2] {
            return Err(Error::Unfit(format!(
                "triangle {i} has the points {t:?}, of {points}"
            )));
        }
    }
    Ok(())
}

/// An unnamed file in memory.
fn memory_file() -> Result<File, Error> {
    // SAFETY: a valid name; the descriptor is checked and then owned by the file alone.
    unsafe {
        let fd = libc::memfd_create(c"tetgen-result".as_ptr(), libc::MFD_CLOEXEC);
        if fd < 0 {
            return Err(Error::system("reserving shared memory"));
        }
        Ok(File::from_raw_fd(fd))
    }
}
