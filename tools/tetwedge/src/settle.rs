//! Surfaces remeshed within the deviation, and the faces that copies share divided as the elements need, before a template is
//! filled.

use mesher::{Error, Log, Params};
use surface::{Followed, Footing, Guide, Report, SurfaceError, follow_shape, settle_faces};
use tmesh::Document;

/// A document whose surface is to stay, and what there is to say about it.
#[derive(Clone)]
pub struct Settled {
    /// The document.
    pub document: Document,
    /// Of each template, what its surface stands on if it was remeshed; empty for none.
    pub footings: Vec<Option<Footing>>,
    /// What surfaces with seams are divided by.
    pub guide: Guide,
    /// Of each template, what was made of faces that copies share; empty for none.
    pub report: Report,
    /// What the user should know, a sentence each.
    pub advice: Vec<String>,
    /// What was remeshed, a sentence for each template.
    pub facts: Vec<String>,
}

impl Settled {
    /// What the user should know, a sentence each.
    pub fn advice(&self) -> Vec<String> {
        let remade = self.report.iter().flatten();
        let advice = remade.filter_map(|remade| remade.advice.clone());
        self.advice.iter().cloned().chain(advice).collect()
    }

    /// Whether there is nothing that the user should know.
    pub fn is_as_asked(&self) -> bool {
        self.advice().is_empty()
    }

    /// What was made, a sentence for each template.
    pub fn facts(&self) -> Vec<String> {
        let remade = self.report.iter().flatten();
        let facts = remade.map(|remade| remade.fact.clone());
        self.facts.iter().cloned().chain(facts).collect()
    }
}

/// A document whose surface follows the shape behind it, and whose shared faces are as they were cut.
pub struct Shaped {
    document: Document,
    followed: Followed,
    /// What is asked for, if shared faces are to be divided.
    params: Option<Params>,
}

impl Shaped {
    /// A document whose surface is to stay.
    pub fn kept(document: Document) -> Self {
        Self {
            document,
            followed: Followed::default(),
            params: None,
        }
    }

    /// Remeshes surfaces.
    ///
    /// # Errors
    /// What another attempt would not change: time, memory, what is asked for.
    pub fn new(mut document: Document, params: &Params, log: Log<'_>) -> Result<Self, Error> {
        // Switches are meant for the tetrahedra.
        let params = Params {
            switches: String::new(),
            ..params.clone()
        };
        let followed = follow_shape(&mut document, &params, log)?;
        followed.facts.iter().for_each(|fact| log.detail(fact));
        Ok(Self {
            document,
            followed,
            params: Some(params),
        })
    }

    /// The document.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// Whether surfaces were remeshed.
    pub fn is_remeshed(&self) -> bool {
        !self.followed.facts.is_empty()
    }

    /// With shared faces as they are.
    pub fn as_it_is(&self) -> Settled {
        Settled {
            document: self.document.clone(),
            footings: self.followed.footings.clone(),
            guide: Guide::Mesher,
            report: vec![None; self.document.templates.len()],
            advice: Vec::new(),
            facts: self.followed.facts.clone(),
        }
    }

    /// With new surfaces of templates with seams, unless all stay.
    ///
    /// # Errors
    /// See [`SurfaceError`].
    pub fn settled(&self, guide: Guide, log: Log<'_>) -> Result<Settled, SurfaceError> {
        let Some(params) = &self.params else {
            return Ok(Settled {
                guide,
                ..self.as_it_is()
            });
        };
        let mut footings = self.followed.footings.clone();
        let (document, report) =
            settle_faces(self.document.clone(), &mut footings, params, (log, guide))?;
        Ok(Settled {
            document,
            footings,
            guide,
            report,
            ..self.as_it_is()
        })
    }
}
