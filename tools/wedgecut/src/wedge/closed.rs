//! Whether a surface closes.

use crate::error::CutError;
use geom::edges::Edges;
use glam::DVec3;
use tmesh::{Frame, Triangle};

/// Around every edge each region must be left as often as it is entered.
///
/// # Errors
/// [`CutError::NotClosed`].
pub fn check_closed(points: &[DVec3], faces: &[Triangle], frame: &Frame) -> Result<(), CutError> {
    let corners: Vec<[u32; 3]> = faces.iter().map(|f| f.vertices).collect();
    let edges = Edges::new(&corners);
    let mut open = 0;
    let mut first = DVec3::ZERO;
    let mut balance: Vec<(u32, i32)> = Vec::new();
    for e in 0..edges.len() {
        balance.clear();
        for u in edges.around(e) {
            let face = &faces[u.triangle as usize];
            let step = if u.forward { 1 } else { -1 };
            for (region, change) in [(face.back, step), (face.front, -step)] {
                match balance.iter_mut().find(|b| b.0 == region) {
                    Some(b) => b.1 += change,
                    None => balance.push((region, change)),
                }
            }
        }
        if balance.iter().any(|b| b.1 != 0) {
            if open == 0 {
                let [a, b] = edges.ends[e].map(|v| points[v as usize]);
                first = frame.to_world(0.5 * (a + b));
            }
            open += 1;
        }
    }
    if open > 0 {
        Err(CutError::NotClosed {
            count: open,
            near: first,
        })
    } else {
        Ok(())
    }
}
