//! Trees over the triangles of a surface: over all of them, and over those of each class.

use crate::shape::interfaces::Interfaces;
use crate::shape::motion::Target;
use geom::tree::{Nearest, Tree};
use glam::DVec3;

/// Trees for the triangle that is nearest to a place.
pub struct Trees {
    all: Part,
    by_class: Vec<Part>,
}

/// A tree over some triangles.
pub struct Part {
    /// The tree.
    pub tree: Tree,
    /// Index of each triangle in the whole surface; empty for all of it.
    triangles: Vec<u32>,
}

impl Part {
    /// The number in the whole surface of a triangle of the tree.
    #[inline]
    pub fn triangle(&self, of_tree: u32) -> u32 {
        self.triangles.get(of_tree as usize).map_or(of_tree, |t| *t)
    }

    /// What the tree has found, as a triangle of the whole surface.
    #[inline]
    pub fn answer(&self, found: Option<Nearest>) -> Option<Nearest> {
        found.map(|hit| Nearest {
            triangle: self.triangle(hit.triangle),
            ..hit
        })
    }
}

impl Trees {
    /// Over triangles with these corners, which stand for what may be as far from each of them as `margin` says.
    pub fn new(
        interfaces: &Interfaces,
        corners: impl Fn(u32) -> [DVec3; 3] + Copy,
        margin: impl Fn(u32) -> f64 + Copy,
    ) -> Self {
        let all = Part {
            tree: Tree::with_margins((0..interfaces.class.len() as u32).map(corners), margin),
            triangles: Vec::new(),
        };
        let count = interfaces.classes.len();
        let mut members = vec![Vec::new(); if count > 1 { count } else { 0 }];
        for (t, &c) in interfaces.class.iter().enumerate() {
            if let Some(members) = members.get_mut(c as usize) {
                members.push(t as u32);
            }
        }
        let part = |triangles: Vec<u32>| Part {
            tree: Tree::with_margins(triangles.iter().map(|&t| corners(t)), |t| {
                margin(triangles[t as usize])
            }),
            triangles,
        };
        Self {
            all,
            by_class: members.into_iter().map(part).collect(),
        }
    }

    /// The part that the image of a triangle may land on.
    #[inline]
    pub fn part(&self, interfaces: &Interfaces, triangle: u32, target: &Target) -> Option<&Part> {
        match target {
            Target::Classes(map) if !self.by_class.is_empty() => {
                let class = map[interfaces.class[triangle as usize] as usize];
                self.by_class.get(class as usize)
            }
            _ => Some(&self.all),
        }
    }
}
