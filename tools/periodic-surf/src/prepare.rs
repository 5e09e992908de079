//! The whole document: every template with a seam gets a new surface, and what follows it the shared face.

use crate::SurfaceError;
use crate::remeshed::{smoothed, tolerance};
use crate::surface::{Other, impose, make};
use mesher::{Climb, Deadline, LADDER, Log, Params, Piece, Sizes, TetGen};
use tmesh::{Document, Template};

/// Sentences about what was done, for the history and the user.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Report {
    /// A sentence for each template.
    pub facts: Vec<String>,
    /// Templates that got a new surface.
    pub remade: usize,
}

/// Makes the surfaces of all templates with a seam. `log` receives details while the work goes on.
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
    let sizes = Sizes::new(&document);
    let mut report = Report::default();
    if params.quality {
        follow_shape(&mut document, &mut report);
    }
    let seams: Vec<bool> = document
        .templates
        .iter()
        .enumerate()
        .map(|(index, template)| has_seam(template, index))
        .collect();
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
    for (index, &seam) in seams.iter().enumerate() {
        if !seam || !params.quality {
            continue;
        }
        if others(&document.templates[index], index).next().is_some() {
            // It follows another one.
            continue;
        }
        let made = remake(&document, index)?;
        document.templates[index] = made.template;
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
                document.templates[follower] = made.template;
                report.add(follower, &document.templates[follower]);
            }
        }
    }
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

/// Remeshes the surfaces within the deviation.
fn follow_shape(document: &mut Document, report: &mut Report) {
    let tolerance = tolerance(document);
    let deviation = if tolerance.drift() > tolerance.equal() && std::env::var("NODEV").is_err() {
        tolerance.drift()
    } else {
        0.0
    };
    if deviation <= 0.0 {
        return;
    }
    for index in 0..document.templates.len() {
        let cosine = libm::cos(30.0_f64.to_radians());
        let lengths = (deviation, tolerance.flat());
        let Some(smoothed) = smoothed(document, index, lengths, cosine) else {
            continue;
        };
        report.facts.push(format!(
            "template {index}: {:?}, {} triangles for {}",
            smoothed.told,
            smoothed.template.triangles.len(),
            document.templates[index].triangles.len()
        ));
        document.templates[index] = smoothed.template;
        for (other, template) in document.templates.iter_mut().enumerate() {
            for gluing in &mut template.gluings {
                if other != index && gluing.other as usize == index {
                    for pair in &mut gluing.vertex_pairs {
                        pair[1] = smoothed.vertices[pair[1] as usize];
                    }
                    for pair in &mut gluing.triangle_pairs {
                        pair[1] = smoothed.triangles[pair[1] as usize];
                    }
                    gluing.sort();
                }
            }
        }
        report.remade += 1;
    }
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
