//! The tools as their users run them: real processes, real pipes, real files.

mod bounds;
mod curved_elements;
mod curved_seams;
mod determinism;
mod deviation;
mod elements;
mod exchanged;
mod failures;
mod folds;
mod groups;
mod hubs;
mod makefiles;
mod pipe;
mod placements;
mod referee;
mod seams;
mod sections;
mod size_field;
mod sizes;
mod small;
mod touching;
