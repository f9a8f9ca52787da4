//! A drawing: curves in their order, from the back to the front.

use crate::background::Background;
use crate::curve::{Curve, CurveId};
use crate::method::Method;
use crate::neatening::Neatening;
use fairpath_fit::TemplateSet;
use fairpath_io::{SHIPPED_TEMPLATES, Unit, YAxis, shipped_templates};
use std::sync::{Arc, OnceLock};

/// What a person has drawn. A copy shares all curves with the original, so that keeping many states costs little.
#[derive(Clone, Debug, Default)]
pub struct Drawing {
    /// Unit of all coordinates.
    pub unit: Unit,
    /// Where the y axis points; a label.
    pub y: YAxis,
    curves: Vec<Arc<Curve>>,
    /// Sets of French curves of this drawing's own.
    pub template_sets: Vec<Arc<TemplateSet>>,
    /// A picture to trace over.
    pub background: Option<Arc<Background>>,
    /// Which drawing of a session this is a state of, since undo leads from one that was opened to the one before. It counts for nothing else: neither is
    /// it compared nor written.
    pub document: u64,
    named: u64,
}

/// Two drawings are equal if the same can be seen and done with them; which identities were given before does not count.
impl PartialEq for Drawing {
    fn eq(&self, other: &Self) -> bool {
        self.unit == other.unit
            && self.y == other.y
            && all_same(self.background.as_slice(), other.background.as_slice())
            && all_same(&self.curves, &other.curves)
            && all_same(&self.template_sets, &other.template_sets)
    }
}

/// Whether two lists hold the same; what is shared, as the states of a history share nearly all, is not looked through.
fn all_same<T: PartialEq>(a: &[Arc<T>], b: &[Arc<T>]) -> bool {
    a.len() == b.len() && a.iter().zip(b).all(|(a, b)| Arc::ptr_eq(a, b) || a == b)
}

impl Drawing {
    /// An empty drawing in that unit.
    #[must_use]
    pub fn new(unit: Unit, y: YAxis) -> Self {
        Self { unit, y, ..Self::default() }
    }

    /// The curves, from the back to the front.
    #[must_use]
    pub fn curves(&self) -> &[Arc<Curve>] {
        &self.curves
    }

    /// The curve of that identity.
    #[must_use]
    pub fn curve(&self, id: CurveId) -> Option<&Arc<Curve>> {
        self.curves.iter().find(|curve| curve.id == id)
    }

    /// An identity that no curve of this drawing ever had.
    pub fn new_id(&mut self) -> CurveId {
        self.named += 1;
        CurveId(self.named)
    }

    /// A name that no curve has yet: the stem with a number.
    #[must_use]
    pub fn free_name(&self, stem: &str) -> String {
        let stem = stem.trim_end_matches(|c: char| c.is_ascii_digit()).trim_end();
        let taken = |name: &String| self.curves.iter().any(|curve| curve.name == *name);
        let mut names = (self.curves.len() + 1..).map(|number| format!("{stem} {number}"));
        names.find(|name| !taken(name)).unwrap_or_else(|| stem.to_owned())
    }

    /// Puts a curve in front, or in the place of the one that has its identity.
    pub fn put(&mut self, curve: Curve) {
        self.named = self.named.max(curve.id.0);
        match self.curves.iter_mut().find(|other| other.id == curve.id) {
            Some(place) => *place = Arc::new(curve),
            None => self.curves.push(Arc::new(curve)),
        }
    }

    /// Puts a curve in the place of a certain state of it; false if the drawing has not got that.
    pub(crate) fn supersede(&mut self, old: &Arc<Curve>, new: &Arc<Curve>) -> bool {
        let place = self.curves.iter_mut().find(|curve| Arc::ptr_eq(curve, old));
        place.map(|place| *place = Arc::clone(new)).is_some()
    }

    /// Gives no identity that another state of the drawing has given.
    pub(crate) fn name_after(&mut self, other: &Self) {
        self.named = self.named.max(other.named);
    }

    /// The same drawing with other identities for all curves, none of which another drawing has given.
    #[must_use]
    pub(crate) fn named_apart(mut self, other: &Self) -> Self {
        self.named = other.named;
        for curve in std::mem::take(&mut self.curves) {
            let id = self.new_id();
            self.curves.push(Arc::new(Curve { id, ..Arc::unwrap_or_clone(curve) }));
        }
        self
    }

    /// Puts curves in the place of one, or in front if there is none of that identity.
    pub fn replace(&mut self, id: CurveId, by: Vec<Curve>) {
        let at = self.curves.iter().position(|curve| curve.id == id);
        self.named = by.iter().map(|curve| curve.id.0).fold(self.named, u64::max);
        let by = by.into_iter().map(Arc::new);
        match at {
            Some(i) => drop(self.curves.splice(i..=i, by)),
            None => self.curves.extend(by),
        }
    }

    /// Takes a curve out.
    pub fn remove(&mut self, id: CurveId) -> Option<Arc<Curve>> {
        let at = self.curves.iter().position(|curve| curve.id == id)?;
        Some(self.curves.remove(at))
    }

    /// The names of all sets of French curves: the drawing's own, then those that come along.
    #[must_use]
    pub fn template_set_names(&self) -> Vec<String> {
        let own = self.template_sets.iter().map(|set| set.name().to_owned());
        own.chain(SHIPPED_TEMPLATES.map(str::to_owned)).collect()
    }

    /// The set of French curves of that name: the drawing's own, or one that comes along.
    #[must_use]
    pub fn template_set(&self, name: &str) -> Option<Arc<TemplateSet>> {
        let own = self.template_sets.iter().find(|set| set.name() == name).cloned();
        own.or_else(|| shipped().iter().find(|set| set.name() == name).cloned())
    }

    /// The set that a method needs, if it needs one.
    #[must_use]
    pub fn templates_for(&self, neatening: &Neatening) -> Option<Arc<TemplateSet>> {
        if neatening.method == Method::FrenchCurve { self.template_set(&neatening.templates) } else { None }
    }
}

/// The sets that come along, read once.
fn shipped() -> &'static [Arc<TemplateSet>] {
    static SETS: OnceLock<Vec<Arc<TemplateSet>>> = OnceLock::new();
    SETS.get_or_init(|| SHIPPED_TEMPLATES.into_iter().filter_map(shipped_templates).map(Arc::new).collect())
}
