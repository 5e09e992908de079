//! The mesher's answer as a template.

use super::filled::{Filled, NONE};
use super::preserved::restore_preserved;
use super::relief::on_relief;
use super::walls::{on_shifted_facets, restore_walls};
use glam::DVec3;
use improve::Leaves;
use mesher::{Answer, Climb, Elements, Error, Piece, Place, Plc, Surface, label};
use surface::{Left, coarsened};
use tmesh::{OUTSIDE, Template, Tet, Triangle};

/// What is known of a filled template that is not finished.
pub struct Origin {
    /// Facet of each triangle.
    pub facets: Vec<usize>,
    /// Wall face of each triangle.
    pub faces: Vec<u32>,
    /// Number of the first vertex that the input does not have.
    pub first_new: usize,
}

/// Makes a filled template from TetGen's mesh of `plc`, coarsened. What it shares with others is settled then, the
/// rest is for [`finish`].
///
/// # Errors
/// [`Error::Unusable`] when anything that must hold does not.
pub fn fill(climb: &Climb<'_>, answer: &Answer, leaves: Leaves) -> Result<(Filled, Origin), Error> {
    let (plc, mesh) = (&answer.plc, &*answer.mesh);
    let Piece {
        index,
        template: input,
        ..
    } = climb.piece;
    let unusable = |what: String| Error::Unusable {
        template: index,
        what,
    };
    if mesh.tetrahedra().is_empty() {
        return Err(unusable("it is empty".to_owned()));
    }
    if !answer.keeps_points() {
        return Err(unusable("input points were moved or left out".to_owned()));
    }
    let cells = label(plc, mesh).map_err(|c| {
        let place = Place(plc.to_model(c.place));
        unusable(format!("there are {} near {place}", c.what))
    })?;

    let in_voids = cells.region.iter().filter(|&&r| r == OUTSIDE);
    let dropped = in_voids.count();
    let Left {
        mut tets,
        surface,
        removed,
    } = coarsened(climb, answer, cells, leaves);

    let numbering = Numbering::new(mesh, &tets, &surface, &plc.vertex_of_point);
    let renumber = |v: u32| numbering.new_id[v as usize];
    let triangles: Vec<Triangle> = surface
        .iter()
        .map(|s| Triangle {
            vertices: s.triangle.vertices.map(renumber),
            ..s.triangle
        })
        .collect();
    let facets: Vec<usize> = surface.iter().map(|s| s.facet).collect();
    let faces: Vec<u32> = facets
        .iter()
        .map(|&f| plc.facets.facets[f].attributes.face)
        .collect();
    for t in &mut tets {
        t.vertices = t.vertices.map(renumber);
    }
    let mut filled = Filled {
        template: Template {
            vertices: numbering.positions(input, answer),
            triangles,
            tets,
            gluings: Vec::new(),
            axis: Vec::new(),
        },
        vertices: numbering.of_input(input, plc),
        triangles: vec![NONE; input.triangles.len()],
        shared: {
            let all = 0..faces.len() as u32;
            all.filter(|&t| climb.piece.shares(faces[t as usize]))
                .collect()
        },
        dropped,
        removed,
        improved: None,
        has_slid: false,
    };
    // Old vertices come first, in their order.
    let first_new = filled.vertices.iter().filter(|&&v| v != NONE).count();
    restore_preserved(input, plc, &faces, &mut filled).map_err(&unusable)?;
    let shifted = on_shifted_facets(plc, &facets, first_new, &filled.template);
    restore_walls(input, (plc, &faces, first_new), shifted, &mut filled).map_err(&unusable)?;
    for (v, there) in on_relief(plc, &facets, &filled.template) {
        if v as usize >= first_new {
            filled.template.vertices[v as usize] = there;
        }
    }
    let origin = Origin {
        facets,
        faces,
        first_new,
    };
    Ok((filled, origin))
}

/// Numbers for the points that the mesh uses: the template's own in their order there, then new ones.
struct Numbering {
    new_id: Vec<u32>,
    count: usize,
}

impl Numbering {
    fn new(
        mesh: &dyn Elements,
        tets: &[Tet],
        surface: &[Surface],
        vertex_of_point: &[u32],
    ) -> Self {
        let mut new_id = vec![NONE; mesh.points().len()];
        for t in tets {
            t.vertices.iter().for_each(|&v| new_id[v as usize] = 0);
        }
        for s in surface {
            s.triangle
                .vertices
                .iter()
                .for_each(|&v| new_id[v as usize] = 0);
        }
        let mut order: Vec<usize> = (0..new_id.len()).collect();
        order[..vertex_of_point.len()].sort_unstable_by_key(|&i| vertex_of_point[i]);
        let mut count = 0;
        for i in order {
            if new_id[i] == 0 {
                new_id[i] = count as u32;
                count += 1;
            }
        }
        Self { new_id, count }
    }

    /// Positions by number: those of the template where they are known, exactly.
    fn positions(&self, input: &Template, answer: &Answer) -> Vec<DVec3> {
        let plc = &answer.plc;
        let mut positions = vec![DVec3::ZERO; self.count];
        for (i, p) in answer.mesh.points().iter().enumerate() {
            if self.new_id[i] != NONE {
                positions[self.new_id[i] as usize] = match plc.vertex_of_point.get(i) {
                    Some(&v) => input.vertices[v as usize],
                    None => plc.to_model(*p),
                };
            }
        }
        positions
    }

    /// The number of each of the template's own vertices, or [`NONE`].
    fn of_input(&self, input: &Template, plc: &Plc) -> Vec<u32> {
        let mut of_vertex = vec![NONE; input.vertices.len()];
        for (point, &v) in plc.vertex_of_point.iter().enumerate() {
            of_vertex[v as usize] = self.new_id[point];
        }
        of_vertex
    }
}
