//! The whole body meshed directly, by the program `tetgen`.

use super::versus::Figures;
use bodies::{Body, Encoding};
use geom::tet::TetMeasures;
use glam::DVec3;
use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Write};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

/// The bounds that the tools have by default, as `tetgen` is told.
const SWITCHES: &str = "-pq1.4/10Q";

/// Meshes a body in a folder with `program`; `None` where it fails, or takes longer than the limit.
///
/// # Errors
/// Fails when files cannot be written or read, or the program not be started.
pub fn mesh(
    program: &Path,
    body: &Body,
    folder: &Path,
    limit: Duration,
) -> io::Result<Option<Figures>> {
    // STL, as it reads it, holds a single solid, and is welded within a tolerance.
    let mut out = BufWriter::new(File::create(folder.join("direct.poly"))?);
    bodies::write(body, Encoding::Poly, &mut out)?;
    out.flush()?;
    drop(out);
    let begun = Instant::now();
    let mut child = Command::new(program)
        .args([SWITCHES, "direct.poly"])
        .current_dir(folder)
        .stdin(Stdio::null())
        .stdout(File::create(folder.join("direct.log"))?)
        .stderr(Stdio::null())
        .spawn()
        .map_err(|e| io::Error::new(e.kind(), format!("cannot run {}: {e}", program.display())))?;
    let status = loop {
        if let Some(status) = child.try_wait()? {
            break status;
        }
        if begun.elapsed() > limit {
            child.kill()?;
            child.wait()?;
            return Ok(None);
        }
        std::thread::sleep(Duration::from_millis(2));
    };
    let seconds = begun.elapsed().as_secs_f64();
    let [nodes, elements] = ["direct.1.node", "direct.1.ele"].map(|name| folder.join(name));
    if !status.success() || !elements.exists() {
        return Ok(None);
    }
    let nodes: Vec<[f64; 3]> = numbers(&nodes)?;
    let elements: Vec<[f64; 4]> = numbers(&elements)?;
    let corner = |id: &f64| nodes.get((*id as usize).wrapping_sub(1)).copied();
    let mut angles = Vec::with_capacity(elements.len());
    let mut volume = 0.0;
    for element in &elements {
        let mut corners = [DVec3::ZERO; 4];
        for (place, id) in corners.iter_mut().zip(element) {
            let found = corner(id).ok_or_else(|| io::Error::other("an element without a node"))?;
            *place = DVec3::from_array(found);
        }
        let measures = TetMeasures::of(corners);
        angles.push(measures.min_dihedral().to_degrees());
        volume += measures.volume.abs();
    }
    if angles.is_empty() {
        return Ok(None);
    }
    // As meshqual has it: the value at the hundredth of the ranks, rounded up.
    let rank = angles.len().div_ceil(100) - 1;
    let p01 = *angles.select_nth_unstable_by(rank, f64::total_cmp).1;
    Ok(Some(Figures {
        tetrahedra: angles.len() as u64,
        p01,
        min: angles.into_iter().fold(f64::INFINITY, f64::min),
        volume,
        seconds,
    }))
}

/// The first numbers after the index of each line of a TetGen file, but for its first line.
fn numbers<const N: usize>(path: &Path) -> io::Result<Vec<[f64; N]>> {
    let mut rows = Vec::new();
    for line in BufReader::new(File::open(path)?).lines().skip(1) {
        let line = line?;
        if line.starts_with('#') {
            continue;
        }
        let mut words = line.split_ascii_whitespace().skip(1);
        let mut row = [0.0; N];
        for x in &mut row {
            let word = words.next().unwrap_or_default();
            *x = word.parse().map_err(io::Error::other)?;
        }
        rows.push(row);
    }
    Ok(rows)
}
