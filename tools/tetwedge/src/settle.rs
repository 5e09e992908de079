//! Surfaces remeshed within the deviation, and the faces that copies share divided as the elements need, before a template is
//! filled.

use mesher::{Error, Log, Params, Progress};
use periodic_surf::{SurfaceError, follow_shape, settle_faces};
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
}

/// Remeshes surfaces and makes those of templates with seams, as `periodic-surf` does, unless that was done before or is
/// not wanted. Faces of a seam that cannot be divided stay as they were cut.
///
/// # Errors
/// What another attempt would not change: time, memory, what is asked for.
pub fn settle(mut document: Document, params: &Params, log: Log<'_>) -> Result<Settled, Error> {
    let kept = |document, advice, facts: Vec<String>| Settled {
        document,
        advice,
        remeshed: !Vec::is_empty(&facts),
        facts,
    };
    let filled = document.templates.iter().any(|t| !t.tets.is_empty());
    if document.wishes.keep_surface() || filled {
        return Ok(kept(document, Vec::new(), Vec::new()));
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
    let mut facts = follow_shape(&mut document, &surface, of_surface)?;
    facts.iter().for_each(|fact| log.detail(fact));
    match settle_faces(document.clone(), &surface, of_surface) {
        Ok((document, report)) => Ok(Settled {
            document,
            advice: report.advice,
            remeshed: !facts.is_empty(),
            facts: {
                if report.remade > 0 {
                    facts.extend(report.facts);
                }
                facts
            },
        }),
        Err(SurfaceError::Mesher(error)) if !error.is_chance() => Err(error),
        Err(error) => Ok(kept(
            document,
            vec![format!(
                "the faces that copies share stay as they were cut, which costs elements or their quality: {error}"
            )],
            facts,
        )),
    }
}
