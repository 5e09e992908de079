//! The whole document: what stands for a curved surface is remeshed, every template with a seam gets a new surface, and what follows it the shared face.

use crate::SurfaceError;
use crate::apart::{apart, note_moved};
use crate::shape::follow_shape;
use crate::surface::{Other, impose, make};
use mesher::{Climb, Deadline, LADDER, Log, Params, Piece, Sizes, TetGen};
use tmesh::{Document, Template};

/// Sentences about what was done, for the history and the user.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// A sentence for each template.
    pub facts: Vec<String>,
    /// What the user should know or do otherwise, a sentence each.
    pub advice: Vec<String>,
    /// Templates that got a new surface.
    pub remade: usize,
}

/// Remeshes all surfaces within the deviation, and makes those of templates with a seam. `log` receives details while the work goes on.
///
/// # Errors
/// See [`SurfaceError`].
pub fn prepare(
    mut document: Document,
    params: &Params,
    log: Log<'_>,
) -> Result<(Document, Report), SurfaceError> {
    let tets = document.templates.iter().map(|t| t.tets.len()).sum();
    if tets > 0 {
        return Err(SurfaceError::AlreadyFilled(tets));
    }
    let mut facts = follow_shape(&mut document, params, log)?.facts;
    let (document, report) = settle_faces(document, params, log)?;
    facts.extend(report.facts);
    Ok((document, Report { facts, ..report }))
}

/// Makes the surfaces of all templates with a seam.
///
/// # Errors
/// See [`SurfaceError`].
pub fn settle_faces(
    mut document: Document,
    params: &Params,
    log: Log<'_>,
) -> Result<(Document, Report), SurfaceError> {
    let mut report = Report::default();
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
    let remake = |document: &Document, template: usize| {
        make(&Climb {
            piece: Piece::of(document, template),
            params,
            sizes: &sizes,
            preserve: false,
            rungs: &LADDER,
            deadline: Deadline::start(params.timeout),
            mesher: &TetGen,
            log,
        })
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
        let made = remake(&document, index)?;
        if made.is_uneven {
            moved = moved.max(apart(&document.templates[index], &made.template));
        }
        document.templates[index] = made.template;
        report.advice.extend(made.advice);
        report.add(index, &document.templates[index]);
        for follower in 0..document.templates.len() {
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
                document.templates[follower] = given;
                let made = remake(&document, follower)?;
                if made.is_uneven {
                    moved = moved.max(apart(&document.templates[follower], &made.template));
                }
                document.templates[follower] = made.template;
                report.advice.extend(made.advice);
                report.add(follower, &document.templates[follower]);
            }
        }
    }
    note_moved(&mut document, moved);
    if report.remade == 0 {
        let why = if seams.contains(&true) {
            "surface kept as cut, no quality is asked for"
        } else {
            "no seam, the mesher may refine all walls"
        };
        report.facts.push(why.to_owned());
    }
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

impl Report {
    fn add(&mut self, index: usize, made: &Template) {
        let seams = || made.gluings.iter().filter(|gluing| gluing.is_seam(index));
        self.facts.push(format!(
            "template {index}: {} triangles, seam of {} vertex pairs and {} triangle pairs",
            made.triangles.len(),
            seams().map(|s| s.vertex_pairs.len()).sum::<usize>(),
            seams().map(|s| s.triangle_pairs.len()).sum::<usize>(),
        ));
        self.remade += 1;
    }
}
