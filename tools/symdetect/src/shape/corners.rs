//! Corners of faces, found by place.

use glam::DVec3;
use rustc_hash::FxHashMap;

/// Cells of the grid of corners per unit of length: of the up to 100,000 corners of a surface, whose area is about
/// that of the unit ball, one cell of 500 x 500 holds a few at most.
const CELLS: f64 = 512.0;
/// Where the grid begins: at no place that coordinates are likely to have.
const START: DVec3 = DVec3::new(-1.618_033_988_7, -1.732_050_807_5, -1.839_286_755_2);

/// Places `first..end` of a list.
#[derive(Clone, Copy)]
struct Run {
    first: u32,
    end: u32,
}

/// Positions of corners in the unit ball, with a grid over them.
pub struct Corners {
    /// The positions.
    pub positions: Vec<DVec3>,
    /// Corners in each cell of the grid.
    cells: FxHashMap<[i32; 3], Run>,
    /// Corners, cell by cell.
    in_cells: Vec<u32>,
}

impl Corners {
    /// Distance up to which corners may be looked for: a quarter of a cell, so that eight cells are looked through at
    /// most, one as a rule.
    pub const FARTHEST: f64 = 0.25 / CELLS;

    /// With a grid over them.
    pub fn new(positions: Vec<DVec3>) -> Self {
        let (cells, in_cells) = cells(&positions);
        Self {
            positions,
            cells,
            in_cells,
        }
    }

    /// A corner at a place, and its distance.
    pub fn at(&self, p: DVec3, within: f64) -> Option<(u32, f64)> {
        let [low, high] = [p - within, p + within].map(cell);
        for x in low[0]..=high[0] {
            for y in low[1]..=high[1] {
                for z in low[2]..=high[2] {
                    let Some(run) = self.cells.get(&[x, y, z]) else {
                        continue;
                    };
                    for &corner in &self.in_cells[run.first as usize..run.end as usize] {
                        let distance = self.positions[corner as usize].distance(p);
                        if distance <= within {
                            return Some((corner, distance));
                        }
                    }
                }
            }
        }
        None
    }
}

/// Cell of the grid that a place is in.
fn cell(p: DVec3) -> [i32; 3] {
    let p = (p - START) * CELLS;
    [p.x as i32, p.y as i32, p.z as i32]
}

fn cells(corners: &[DVec3]) -> (FxHashMap<[i32; 3], Run>, Vec<u32>) {
    let mut cells: FxHashMap<[i32; 3], Run> = FxHashMap::default();
    cells.reserve(corners.len());
    for p in corners {
        cells
            .entry(cell(*p))
            .or_insert(Run { first: 0, end: 0 })
            .end += 1;
    }
    let mut end = 0;
    let mut in_cells = vec![0; corners.len()];
    for run in cells.values_mut() {
        let count = run.end;
        (run.first, run.end) = (end, end);
        end += count;
    }
    for (p, i) in corners.iter().zip(0..) {
        if let Some(run) = cells.get_mut(&cell(*p)) {
            in_cells[run.end as usize] = i;
            run.end += 1;
        }
    }
    (cells, in_cells)
}
