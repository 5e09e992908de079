//! The tetrahedra of copies, block by block.

use super::copies::{BLOCK, Copies, Ids};
use interchange::{Middles, TetBlock, TetRegionBlock, TetRegionSink, TetSink};
use std::io;
use std::ops::Range;
use tmesh::{Instance, Tet};

impl Copies<'_> {
    /// Gives the tetrahedra of some instances. Those of orientation-reversing instances are turned
    /// over.
    pub fn give_tets(
        &self,
        instances: Range<usize>,
        ids: Ids,
        sink: &mut TetSink<'_>,
    ) -> io::Result<()> {
        let mut list = Vec::new();
        let mut vertices = Vec::with_capacity(BLOCK);
        let mut regions = Vec::with_capacity(BLOCK);
        let mut middles = Vec::new();
        for i in instances {
            let instance = &self.document.instances[i];
            let tets = &self.document.templates[instance.template as usize].tets;
            if tets.is_empty() {
                continue;
            }
            self.point_ids(i, ids, &mut list);
            let reversed = instance.isometry.reverses_orientation();
            for (chunk, part) in tets.chunks(BLOCK).enumerate() {
                middles.clear();
                if let Some(all) = self.middles {
                    let at = chunk * BLOCK;
                    let of_part = &all.tets[instance.template as usize][at..at + part.len()];
                    middles.extend(of_part.iter().map(|&middles| {
                        let turned = if reversed {
                            Middles::reversed(middles)
                        } else {
                            middles
                        };
                        turned.map(|v| list[v as usize])
                    }));
                }
                vertices.clear();
                let mapped = part
                    .iter()
                    .map(|tet| tet.vertices.map(|v| list[v as usize]));
                if reversed {
                    vertices.extend(mapped.map(|[a, b, c, d]| [a, b, d, c]));
                } else {
                    vertices.extend(mapped);
                }
                self.place_regions(instance, part, &mut regions);
                sink(&TetBlock {
                    vertices: &vertices,
                    middles: &middles,
                    regions: &regions,
                    instance: i as u32,
                })?;
            }
        }
        Ok(())
    }

    /// Gives the regions of the tetrahedra of some instances.
    pub fn give_regions(
        &self,
        instances: Range<usize>,
        sink: &mut TetRegionSink<'_>,
    ) -> io::Result<()> {
        let mut regions = Vec::with_capacity(BLOCK);
        for i in instances {
            let instance = &self.document.instances[i];
            let tets = &self.document.templates[instance.template as usize].tets;
            for part in tets.chunks(BLOCK) {
                self.place_regions(instance, part, &mut regions);
                sink(&TetRegionBlock {
                    regions: &regions,
                    instance: i as u32,
                })?;
            }
        }
        Ok(())
    }

    fn place_regions(&self, instance: &Instance, tets: &[Tet], regions: &mut Vec<u32>) {
        regions.clear();
        if instance.region_map == 0 {
            regions.extend(tets.iter().map(|tet| tet.region));
        } else {
            let placed = |region| self.document.placed_region(instance, region);
            regions.extend(tets.iter().map(|tet| placed(tet.region)));
        }
    }
}
