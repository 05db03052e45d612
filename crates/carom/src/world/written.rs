//! Serialization of a world: its state.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::World;
use crate::state::State;

impl Serialize for World {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.state.serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for World {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let state = State::deserialize(deserializer)?;
        Ok(Self { state, ..Self::default() })
    }
}
