//! The whole document: every template with a seam gets a new surface, and what follows it the shared face.

use crate::SurfaceError;
use crate::apart::{apart, note_moved};
use crate::footing::Footing;
use crate::seams::{Guide, Made, Other, impose, make};
use mesher::{Climb, Deadline, LADDER, Log, Params, Piece, Sizes, TetGen};
use tmesh::{Document, Template};

/// What was made of a template's surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Remade {
    /// A sentence about it.
    pub fact: String,
    /// What the user should know or do otherwise.
    pub advice: Option<String>,
}

/// What was made of all of them; `None` for those that stay.
pub type Report = Vec<Option<Remade>>;

/// Makes the surfaces of all templates with a seam. `footings` are what these stand on, where that is known, and what the new ones do then. `log`
/// receives details while the work goes on.
///
/// # Errors
/// See [`SurfaceError`].
pub fn settle_faces(
    mut document: Document,
    footings: &mut [Option<Footing>],
    params: &Params,
    (log, guide): (Log<'_>, Guide),
) -> Result<(Document, Report), SurfaceError> {
    let mut report: Report = vec![None; document.templates.len()];
    let seams: Vec<bool> = document
        .templates
        .iter()
        .enumerate()
        .map(|(index, template)| has_seam(template, index))
        .collect();
    // Without a seam nobody asks.
    let sizes = match seams.contains(&true) {
        true => Sizes::new(&document).map_err(mesher::Error::from)?,
        false => Sizes::of_regions(&document),
    };
    let remake = |document: &Document, template: usize, footing: Option<&Footing>| {
        let climb = Climb {
            piece: Piece {
                apart: footing.map_or(&[], |footing| &footing.apart),
                ..Piece::of(document, template)
            },
            params,
            sizes: &sizes,
            preserve: false,
            rungs: &LADDER,
            deadline: Deadline::start(params.timeout),
            mesher: &TetGen,
            log,
        };
        make(&climb, guide)
    };
    // How far surfaces have moved that have uneven faces, model units.
    let mut moved = 0.0_f64;
    for (index, &seam) in seams.iter().enumerate() {
        if !seam || !params.quality {
            continue;
        }
        if others(&document.templates[index], index).next().is_some() {
            // It follows another one.
            continue;
        }
        let footing = footings.get_mut(index);
        let made = remake(
            &document,
            index,
            footing.as_deref().and_then(Option::as_ref),
        )?;
        if let Some(footing) = footing {
            *footing = footing.take().map(|f| f.with_facets(&made.facets));
        }
        if made.is_uneven {
            moved = moved.max(apart(&document.templates[index], &made.template));
        }
        report[index] = Some(Remade::of(index, &made));
        document.templates[index] = made.template;
        for (follower, told) in report.iter_mut().enumerate() {
            if others(&document.templates[follower], follower).any(|o| o == index) {
                let other = Other {
                    template: &document.templates[index],
                    vertices: &made.vertices,
                    triangles: &made.shared,
                };
                let given =
                    impose(&document, follower, &other).map_err(|what| SurfaceError::Changed {
                        template: follower,
                        what,
                    })?;
                // It has other triangles now.
                if let Some(footing) = footings.get_mut(follower) {
                    *footing = None;
                }
                document.templates[follower] = given;
                let made = remake(&document, follower, None)?;
                if made.is_uneven {
                    moved = moved.max(apart(&document.templates[follower], &made.template));
                }
                *told = Some(Remade::of(follower, &made));
                document.templates[follower] = made.template;
            }
        }
    }
    note_moved(&mut document, moved);
    if seams.contains(&true) {
        document.wishes.keep_surface = Some(true);
    }
    Ok((document, report))
}

fn has_seam(template: &Template, own: usize) -> bool {
    template.gluings.iter().any(|gluing| gluing.is_seam(own))
}

/// Other templates that a template shares a face with.
fn others(template: &Template, own: usize) -> impl Iterator<Item = usize> {
    let gluings = template.gluings.iter();
    gluings.filter_map(move |gluing| gluing.other_than(own))
}

impl Remade {
    fn of(
        index: usize,
        Made {
            template, advice, ..
        }: &Made,
    ) -> Self {
        let seams = || {
            template
                .gluings
                .iter()
                .filter(|gluing| gluing.is_seam(index))
        };
        let fact = format!(
            "template {index}: {} triangles, seam of {} vertex pairs and {} triangle pairs",
            template.triangles.len(),
            seams().map(|s| s.vertex_pairs.len()).sum::<usize>(),
            seams().map(|s| s.triangle_pairs.len()).sum::<usize>(),
        );
        Self {
            fact,
            advice: advice.clone(),
        }
    }
}
