//! What a Gmsh mesh says, and the mesh that this is.

use super::node_data::{View, point_mesh};
use crate::ReadError;
use crate::parsed::{Grid, Parsed, PointMesh, Shells, TETRA, TRIANGLE, Volume, by_corners};
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::collections::{BTreeMap, BTreeSet};

/// What the file says, with points numbered from 0.
#[derive(Default)]
pub struct File {
    /// Positions, file units.
    pub points: Vec<DVec3>,
    /// Index of each node, unless nodes are numbered 1, 2, 3, ...
    pub index: Option<FxHashMap<u64, u32>>,
    /// Corners of each triangle, and the group that it is in.
    pub triangles: Vec<([u32; 3], Group)>,
    /// Corners of each tetrahedron, and the group that it is in.
    pub tets: Vec<([u32; 4], Group)>,
    /// Name of each physical group, by dimension and number.
    pub names: BTreeMap<(i64, i64), String>,
    /// Physical group of each entity, by dimension and number; of version 4.1.
    pub physical: FxHashMap<(i64, i64), i64>,
    /// Surfaces around each volume; of version 4.1.
    pub volumes: Vec<(i64, Vec<i64>)>,
    /// Number of elements of higher order.
    pub curved: usize,
    /// What a comment says, if anything.
    pub title: String,
    /// Numbers at nodes, if they are wanted.
    pub views: Option<Vec<View>>,
    /// Cells of volume that are no tetrahedra, if numbers at nodes are wanted.
    pub others: Vec<Vec<u32>>,
}

/// Physical group, or 0, and entity of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Group {
    /// Number of the physical group; 0 where there is none.
    pub physical: i64,
    /// Number of the entity.
    pub entity: i64,
}

impl Group {
    /// Elements with the same key belong together.
    fn key(self) -> (bool, i64) {
        if self.physical == 0 {
            (true, self.entity)
        } else {
            (false, self.physical)
        }
    }
}

impl File {
    /// The mesh with the numbers at its nodes.
    pub fn points(self) -> PointMesh {
        let mut mesh = PointMesh {
            points: self.points,
            ..PointMesh::default()
        };
        self.tets.iter().for_each(|(t, _)| mesh.add_volume(t));
        self.others.iter().for_each(|cell| mesh.add_volume(cell));
        self.triangles.iter().for_each(|(t, _)| mesh.add_face(t));
        point_mesh(mesh, self.index.as_ref(), self.views.unwrap_or_default())
    }

    /// The mesh, or the surface where there are no tetrahedra.
    ///
    /// # Errors
    /// What no mesh or surface can be made of.
    pub fn build(self, precision: f64) -> Result<Parsed, ReadError> {
        if self.tets.is_empty() {
            Ok(Parsed::Shells(self.surface(precision)))
        } else {
            self.volume(precision)
        }
    }

    /// Ids of groups and their names: the physical group's number, or a free one.
    fn ids(
        &self,
        dimension: i64,
        word: &str,
        groups: impl Iterator<Item = Group>,
    ) -> (FxHashMap<Group, u32>, Vec<(u32, String)>) {
        let groups: BTreeSet<Group> = groups.collect();
        let fits = |tag: i64| u32::try_from(tag).ok().filter(|&t| t != u32::MAX);
        let physical = groups.iter().filter_map(|g| fits(g.physical));
        let any = groups.iter().any(|g| g.physical != 0);
        let mut next = if any { physical.max().unwrap_or(0) } else { 0 };
        let mut ids = FxHashMap::default();
        let mut of_key: BTreeMap<(bool, i64), u32> = BTreeMap::new();
        let mut names = BTreeMap::new();
        for group in groups {
            let id = *of_key.entry(group.key()).or_insert_with(|| {
                let own = if any { group.physical } else { group.entity };
                match fits(own) {
                    Some(id) if own != 0 || !any => id,
                    _ => {
                        next = next.saturating_add(1).min(u32::MAX - 1);
                        next
                    }
                }
            });
            ids.insert(group, id);
            let name = self.names.get(&(dimension, group.physical));
            let name = name
                .filter(|n| group.physical != 0 && !n.is_empty())
                .cloned();
            names
                .entry(id)
                .or_insert_with(|| name.unwrap_or_else(|| format!("{word}{id}")));
        }
        (ids, names.into_iter().collect())
    }

    /// A tetrahedral mesh, with surface where the file has triangles.
    fn volume(self, precision: f64) -> Result<Parsed, ReadError> {
        let (region, regions) = self.ids(3, "region", self.tets.iter().map(|t| t.1));
        let (marker, markers) = self.ids(2, "marker", self.triangles.iter().map(|t| t.1));
        let lines = |names: &[(u32, String)]| -> String {
            let line = |(id, name): &(u32, String)| {
                format!("{id} {}\n", name.replace(|c: char| c.is_control(), " "))
            };
            names.iter().map(line).collect()
        };
        let mut grid = Grid {
            title: self.title,
            relative_precision: precision,
            notices: by_corners(self.curved).into_iter().collect(),
            ..Grid::default()
        };
        grid.texts
            .insert("region_names".to_owned(), lines(&regions));
        grid.texts
            .insert("marker_names".to_owned(), lines(&markers));
        let (mut region_of, mut marker_of) = (Vec::new(), Vec::new());
        for &(t, group) in &self.tets {
            grid.add(TETRA, &t);
            region_of.push(region[&group]);
            marker_of.push(u32::MAX);
        }
        for &(t, group) in &self.triangles {
            grid.add(TRIANGLE, &t);
            region_of.push(u32::MAX);
            marker_of.push(marker[&group]);
        }
        grid.cell_data.insert("region".to_owned(), region_of);
        grid.cell_data.insert("marker".to_owned(), marker_of);
        grid.points = self.points;
        grid.drop_unused_points();
        grid.parsed("msh")
    }

    fn surface(self, precision: f64) -> Shells {
        let (marker, markers) = self.ids(2, "surface", self.triangles.iter().map(|t| t.1));
        let named = |(&(dimension, tag), name): (&(i64, i64), &String)| {
            let id = u32::try_from(tag).ok().filter(|&id| id != u32::MAX)?;
            (dimension == 3).then(|| (id, name.clone()))
        };
        let names: BTreeMap<u32, String> = self.names.iter().filter_map(named).collect();
        let mut volumes: Vec<Volume> = self
            .volumes
            .iter()
            .filter_map(|(tag, around)| {
                let physical = *self.physical.get(&(3, *tag))?;
                let id = u32::try_from(physical).ok()?;
                Some(Volume {
                    id,
                    name: names.get(&id)?.clone(),
                    around: around.iter().copied().collect(),
                })
            })
            .collect();
        if volumes.is_empty() {
            // Version 2 has no entities; names of volumes may be there all the same.
            volumes = names
                .into_iter()
                .map(|(id, name)| Volume {
                    id,
                    name,
                    around: BTreeSet::new(),
                })
                .collect();
        }
        let triangles = self.triangles.iter();
        Shells {
            triangles: triangles
                .map(|&(t, group)| (t, marker[&group], group.entity))
                .collect(),
            points: self.points,
            markers,
            volumes,
            relative_precision: precision,
            notices: by_corners(self.curved).into_iter().collect(),
        }
    }
}
