//! Surfaces remeshed within the deviation, and the faces that copies share divided as the elements need, before a template is
//! filled.

use mesher::{Error, Log, Params, Progress};
use periodic_surf::{Followed, Footing, SurfaceError, follow_shape, settle_faces};
use tmesh::Document;

/// A document whose surface is to stay, and what there is to say about it.
pub struct Settled {
    /// The document.
    pub document: Document,
    /// What the user should know, a sentence each.
    pub advice: Vec<String>,
    /// What was made, a sentence for each template.
    pub facts: Vec<String>,
    /// Whether surfaces were remeshed.
    pub remeshed: bool,
    /// Of each template, what its surface stands on if it was remeshed; empty for none.
    pub footings: Vec<Option<Footing>>,
}

/// Remeshes surfaces and makes those of templates with seams, as `periodic-surf` does, unless that was done before or is
/// not wanted. Faces of a seam that cannot be divided stay as they were cut.
///
/// # Errors
/// What another attempt would not change: time, memory, what is asked for.
pub fn settle(mut document: Document, params: &Params, log: Log<'_>) -> Result<Settled, Error> {
    let kept = |document, advice, followed: Followed| Settled {
        document,
        advice,
        remeshed: !followed.facts.is_empty(),
        facts: followed.facts,
        footings: followed.footings,
    };
    let filled = document.templates.iter().any(|t| !t.tets.is_empty());
    if document.wishes.keep_surface() || filled {
        return Ok(kept(document, Vec::new(), Followed::default()));
    }
    // Switches are meant for the tetrahedra.
    let surface = Params {
        switches: String::new(),
        ..params.clone()
    };
    let detail = |text: &str| log.detail(text);
    let progress = |progress: &Progress<'_>| {
        let step = &format!("surface mesh, {}", progress.step);
        log.progress(&Progress { step, ..*progress });
    };
    let of_surface = match log.has_progress() {
        true => Log::new(&detail).with_progress(&progress),
        false => log,
    };
    let followed = follow_shape(&mut document, &surface, of_surface)?;
    followed.facts.iter().for_each(|fact| log.detail(fact));
    match settle_faces(document.clone(), &surface, of_surface) {
        Ok((settled, report)) => {
            let mut kept = kept(settled, report.advice, followed);
            if report.remade > 0 {
                kept.facts.extend(report.facts);
            }
            // What was made anew has other triangles.
            let templates = document.templates.iter().zip(&kept.document.templates);
            for ((before, after), footing) in templates.zip(&mut kept.footings) {
                footing.take_if(|_| before.triangles != after.triangles);
            }
            Ok(kept)
        }
        Err(SurfaceError::Mesher(error)) if !error.is_chance() => Err(error),
        Err(error) => Ok(kept(
            document,
            vec![format!(
                "the faces that copies share stay as they were cut, which costs elements or their quality: {error}"
            )],
            followed,
        )),
    }
}
