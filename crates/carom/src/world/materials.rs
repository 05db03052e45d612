//! Pairs of materials of a world.

use super::World;
use crate::error::{Error, Subject};
use crate::id::SphereId;
use crate::material_pair::{MaterialPair, MaterialPairs};

impl World {
    /// Pairs of materials with coefficients of their own.
    pub fn material_pairs(&self) -> &[MaterialPair] {
        self.state.material_pairs.list()
    }

    /// Factor of the contact distance of two spheres: 1 plus their non-additivity parameter. 1 for spheres that left.
    pub(crate) fn distance_factor(&self, spheres: [SphereId; 2]) -> f64 {
        let non_additivity = &self.state.material_pairs.non_additivity;
        if non_additivity.is_none() {
            return 1.0;
        }
        let [first, second] = spheres.map(|id| {
            let index = self.state.spheres.index_of(id);
            index.map_or(0, |index| self.state.spheres.properties.material(index))
        });
        non_additivity.factor([first, second])
    }

    /// Replaces the pairs of materials; later steps use them.
    ///
    /// # Errors [`Error::Invalid`] for an invalid number, the material 0, or a pair that is given twice, in whatever
    /// order; then the old pairs stay.
    pub fn set_material_pairs(
        &mut self,
        pairs: impl IntoIterator<Item = MaterialPair>,
    ) -> Result<(), Error> {
        let pairs = MaterialPairs::new(pairs.into_iter().collect());
        let pairs = pairs.map_err(|invalid| invalid.about(Subject::Settings))?;
        self.state.changed().material_pairs = pairs;
        Ok(())
    }
}
