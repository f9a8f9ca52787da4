//! A document: commands with the states that they led to, and what follows from the present one.
//!
//! A state shares all that did not change with its neighbours, and nothing is ever computed backwards, so that undoing and doing again give the same bits.

mod apply;
mod command;
mod derive;
mod error;
mod lasso;
mod state;
mod strokes;

pub use apply::{NoFiles, Outcome, Terrains};
pub use command::{Command, CrossingSet, RawLayout, RawSample, SketchAs, TerrainSource};
pub use derive::{PathResult, Results};
pub use error::CommandError;
pub use state::{FoliageRegion, LaidTerrain, Settings, State};

use crate::network::PathId;
use fairpath_fit::Warning;
use std::sync::Arc;

/// A state with what follows from it.
#[derive(Clone, Debug, Default)]
struct Step {
    state: Arc<State>,
    results: Option<Arc<Results>>,
}

/// A document with its past.
#[derive(Clone, Debug, Default)]
pub struct Document {
    /// Every command that is not undone, and then those that are, in the order in which they were given.
    commands: Vec<Command>,
    /// The state after each command; the first one before all of them.
    steps: Vec<Step>,
    /// How many commands are not undone.
    done: usize,
}

impl Document {
    /// A document without anything.
    #[must_use]
    pub fn new() -> Self {
        Self { commands: Vec::new(), steps: vec![Step::default()], done: 0 }
    }

    /// What was said so far.
    #[must_use]
    pub fn state(&self) -> &State {
        &self.steps[self.done].state
    }

    /// What follows from that; nothing before there is a terrain.
    #[must_use]
    pub fn results(&self) -> Option<&Arc<Results>> {
        self.steps[self.done].results.as_ref()
    }

    /// The commands that led here.
    #[must_use]
    pub fn commands(&self) -> &[Command] {
        &self.commands[..self.done]
    }

    /// Does a command. What had been undone is forgotten.
    ///
    /// # Errors
    /// When it cannot be done; the document is then as it was.
    pub fn run(&mut self, command: Command, files: &dyn Terrains) -> Result<Outcome, CommandError> {
        let (step, outcome) = self.tried(&command, files)?;
        self.commands.truncate(self.done);
        self.steps.truncate(self.done + 1);
        self.commands.push(command);
        self.steps.push(step);
        self.done += 1;
        Ok(outcome)
    }

    /// What would follow if a command were done: for previews. The document stays as it is.
    ///
    /// # Errors
    /// As [`run`](Self::run).
    pub fn preview(&self, command: &Command, files: &dyn Terrains) -> Result<Option<Arc<Results>>, CommandError> {
        Ok(self.tried(command, files)?.0.results)
    }

    fn tried(&self, command: &Command, files: &dyn Terrains) -> Result<(Step, Outcome), CommandError> {
        let now = &self.steps[self.done];
        let crossings = now.results.as_ref().map_or(&[][..], |r| &r.crossings);
        let (state, mut outcome) = apply::apply(&now.state, crossings, command, files)?;
        let before = now.results.as_ref().map(|results| (now.state.as_ref(), results.as_ref()));
        let results = state.terrain.as_ref().map(|terrain| derive::derive(before, &state, terrain));
        if let Some(unordered) = results.as_ref().and_then(|r| r.unordered.as_ref()) {
            let results = results.as_ref().map_or(&[][..], |r| &r.crossings);
            return Err(error::ring(unordered, |c| describe(&state, results, c)));
        }
        // Told once, and again only if the reason is another one.
        let told: Vec<_> = now.results.iter().flat_map(|r| r.infeasible()).map(|(p, reason)| (p.id, reason)).collect();
        for (path, reason) in results.iter().flat_map(Results::infeasible) {
            if told.contains(&(path.id, reason)) {
                continue;
            }
            let code = "not-engineered".to_owned();
            let text = format!("path {:?} follows the ground instead of being engineered: {reason}", path.name);
            outcome.warnings.push(Warning { code, text });
        }
        Ok((Step { state: Arc::new(state), results: results.map(Arc::new) }, outcome))
    }

    /// Goes back before the last command; false if there is none.
    pub fn undo(&mut self) -> bool {
        let any = self.done > 0;
        self.done -= usize::from(any);
        any
    }

    /// Does again what was undone last; false if nothing was.
    pub fn redo(&mut self) -> bool {
        let any = self.done < self.commands.len();
        self.done += usize::from(any);
        any
    }

    /// What would follow from the present state if nothing were known of what was before: the same as [`results`](Self::results), for tests of that.
    #[must_use]
    pub fn results_anew(&self) -> Option<Results> {
        let state = self.state();
        state.terrain.as_ref().map(|terrain| derive::derive(None, state, terrain))
    }
}

/// A crossing in words.
fn describe(state: &State, crossings: &[crate::network::Crossing], crossing: usize) -> String {
    let name = |id: PathId| state.path_of(id).map_or("?", |p| p.name.as_str());
    crossings.get(crossing).and_then(|c| Some((c, c.upper_lower()?))).map_or_else(String::new, |(c, [upper, lower])| {
        format!("{:?} over {:?} at ({:.1}, {:.1})", name(upper.path), name(lower.path), c.point.x, c.point.y)
    })
}
