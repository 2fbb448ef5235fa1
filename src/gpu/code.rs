//! The code that passes run: each pass as it was last compiled, with the words of its parameters and the places of its loops.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Arc;

use super::pipeline::Pipeline;
use crate::passes::Pass;
use crate::shader::{Features, Library, LinkedParameter, Parameter, Place};

/// What parameters of shaders are set to, by their names; those that are not in here have their defaults. A switch is 0 or 1.
pub type Values = BTreeMap<String, f64>;

/// Loops of one pipeline are numbered within so many.
pub(super) const LOOPS: u32 = 4096;

/// A pass as it is compiled now.
#[derive(Clone)]
pub struct Use {
    pub pass: &'static Pass,
    /// The scene's features when it was last asked for.
    pub features: Features,
    /// Those of them that its import closure names.
    pub(super) key: Features,
    /// The modules it was linked from.
    pub(super) imports: BTreeSet<String>,
    /// Where the loops of an edited shader are in its text as it is now, of which the pipeline may be older.
    pub(super) loops: Vec<Place>,
    /// Those of its modules, as the text declares them now, in the order of their words.
    pub(super) parameters: Vec<LinkedParameter>,
    pub(super) pipeline: Arc<Pipeline>,
}

impl Use {
    /// The words that its parameters come to.
    pub(super) fn words(&self, values: &Values) -> Vec<u32> {
        self.parameters.iter().map(|linked| word(linked, values)).collect()
    }

    /// Of those words, the ones that it reads, by name.
    pub(super) fn read(&self, values: &Values) -> BTreeMap<&str, u32> {
        let read = self.parameters.iter().filter(|linked| linked.is_read);
        read.map(|linked| (linked.parameter.name.as_str(), word(linked, values))).collect()
    }

    /// The place of a loop by the number that the shader gives it.
    pub(super) fn place_of_loop(&self, number: u32) -> Option<&Place> {
        let first = self.pipeline.serial.wrapping_mul(LOOPS);
        self.loops.get(number.checked_sub(first + 1)? as usize)
    }
}

fn word(linked: &LinkedParameter, values: &Values) -> u32 {
    let parameter = &linked.parameter;
    parameter.word(parameter.value(values.get(&parameter.name).copied()))
}

/// Passes as they were compiled, by name and all features of the scenes that asked for them. Where two scenes' features differ in what a
/// pass's import closure does not name, both share its pipeline.
pub(super) type Kept = HashMap<(&'static str, Features), Use>;

/// The code that passes run, with all that was compiled of it: what is put in the place of what was there, and can be put back.
pub struct Code {
    pub(super) library: Library,
    pub(super) uses: BTreeMap<&'static str, Use>,
    pub(super) kept: Kept,
}

impl Code {
    /// All parameters that it declares, by name.
    pub fn parameters(&self) -> Arc<[Parameter]> {
        parameters_of(&self.library)
    }

    pub(super) fn new(library: Library, uses: Vec<Use>) -> Self {
        let kept = uses.iter().map(|used| ((used.pass.name, used.features.clone()), used.clone())).collect();
        Self { library, uses: uses.into_iter().map(|used| (used.pass.name, used)).collect(), kept }
    }
}

/// All parameters that a library declares; none where that can't be said, which linking does.
pub(super) fn parameters_of(library: &Library) -> Arc<[Parameter]> {
    library.parameters().unwrap_or_default().into()
}
