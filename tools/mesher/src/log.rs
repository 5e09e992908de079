//! What is heard of the work while it goes on.

/// Receives what there is to say while the work goes on.
#[derive(Clone, Copy)]
pub struct Log<'a> {
    detail: &'a (dyn Fn(&str) + Sync),
    progress: Option<&'a (dyn Fn(&Progress<'_>) + Sync)>,
}

/// How far the mesh of a template is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress<'a> {
    /// The template's number.
    pub template: usize,
    /// What is being done, a phrase such as "refining mesh".
    pub step: &'a str,
    /// Points so far, about; 0 where that is not known.
    pub points: f64,
    /// Tetrahedra so far, about; 0 where that is not known.
    pub tetrahedra: f64,
}

impl<'a> Log<'a> {
    /// Hears of details, a sentence each.
    pub fn new(detail: &'a (dyn Fn(&str) + Sync)) -> Self {
        Self {
            detail,
            progress: None,
        }
    }

    /// Hears of progress as well, at each new step and a few times a second.
    pub fn with_progress(self, progress: &'a (dyn Fn(&Progress<'_>) + Sync)) -> Self {
        Self {
            progress: Some(progress),
            ..self
        }
    }

    /// Says a detail.
    pub fn detail(&self, text: &str) {
        (self.detail)(text);
    }

    /// Says how far a template is.
    pub fn progress(&self, progress: &Progress<'_>) {
        if let Some(hear) = self.progress {
            hear(progress);
        }
    }

    /// Whether anybody hears of progress.
    pub fn has_progress(&self) -> bool {
        self.progress.is_some()
    }
}
