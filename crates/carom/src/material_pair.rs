//! Pairs of materials whose coefficients no combine rule gives.

use std::ops::RangeInclusive;

use educe::Educe;

use crate::error::InvalidValue;
use crate::friction::{ContactFriction, Friction};
use crate::non_additivity::NonAdditivity;
use crate::restitution::{BodyRestitution, ContactRestitution, RestitutionLaw};
use crate::validate;

/// Smaller contact distances would be of the size of what contacts of spheres tolerate, larger ones make each sphere a
/// neighbour of many.
const NON_ADDITIVITIES: RangeInclusive<f64> = -0.9..=9.0;

/// Coefficients of the contacts of two materials, instead of those that the combine rules give.
///
/// Materials are numbers from 1 on that spheres and colliders bear ([`Sphere::material`](crate::Sphere::material)); a
/// pair holds in both orders, and may name one material twice.
///
/// ```
/// use carom::{MaterialPair, World};
///
/// let (steel, felt) = (1, 2);
/// let mut world = World::default();
/// world.set_material_pairs([MaterialPair::new(steel, felt).with_restitution(0.3).with_friction(0.2)])?;
/// assert!(world.set_material_pairs([MaterialPair::new(0, felt)]).is_err());
/// # Ok::<(), carom::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub struct MaterialPair {
    /// The two materials, each > 0.
    pub materials: [u8; 2],
    /// Coefficient of restitution in \[0, 1\]; `None` for that of the combine rule.
    pub restitution: Option<f64>,
    /// Law of restitution, instead of `restitution`.
    pub restitution_law: Option<RestitutionLaw>,
    /// Friction; a coefficient that is `None` is that of the combine rule.
    pub friction: Friction,
    /// Non-additivity parameter Δ from -0.9 to 9: two spheres touch where their centres are `(1 + Δ)` times the sum of
    /// their radii apart. Without effect on colliders. 0 unless given.
    pub non_additivity: f64,
}

impl MaterialPair {
    /// A pair that leaves all coefficients to the combine rules.
    pub fn new(first: u8, second: u8) -> Self {
        let materials = [first, second];
        let (restitution, restitution_law, friction) = Default::default();
        Self { materials, restitution, restitution_law, friction, non_additivity: 0.0 }
    }

    /// Returns the pair with this coefficient of restitution.
    pub fn with_restitution(self, restitution: f64) -> Self {
        Self { restitution: Some(restitution), restitution_law: None, ..self }
    }

    /// Returns the pair with this law of restitution.
    pub fn with_restitution_law(self, law: RestitutionLaw) -> Self {
        Self { restitution_law: Some(law), ..self }
    }

    /// Returns the pair with this friction: a coefficient, or a [`Friction`].
    pub fn with_friction(self, friction: impl Into<Friction>) -> Self {
        Self { friction: friction.into(), ..self }
    }

    /// Returns the pair with this non-additivity parameter.
    ///
    /// ```
    /// use carom::{DVec3, MaterialPair, Sphere, World};
    ///
    /// let mut world = World::default();
    /// world.set_material_pairs([MaterialPair::new(1, 2).with_non_additivity(0.5)])?;
    /// let at = |x: f64, material| Sphere::new(DVec3::X * x, 0.5).with_material(material);
    /// world.add_sphere(at(0.0, 1).with_velocity(DVec3::X))?;
    /// world.add_sphere(at(2.0, 2))?;
    /// // Their diameters are 1 m, and their centres 1.5 m apart when they touch.
    /// world.step(1.0)?;
    /// assert_eq!(world.report().impacts[0].time, 0.5);
    /// # Ok::<(), carom::Error>(())
    /// ```
    pub fn with_non_additivity(self, non_additivity: f64) -> Self {
        Self { non_additivity, ..self }
    }

    /// Restitution of its contacts, if it is given.
    pub(crate) fn contact_restitution(&self) -> Option<ContactRestitution> {
        let law = self.restitution_law.map(BodyRestitution::BySpeed);
        law.or(self.restitution.map(BodyRestitution::Constant)).map(ContactRestitution::given)
    }

    /// Replaces the coefficients of friction that are given.
    pub(crate) fn apply_friction(&self, friction: &mut ContactFriction) {
        let Friction { sliding, rolling, spinning, tangential_restitution } = self.friction;
        *friction = ContactFriction {
            sliding: sliding.unwrap_or(friction.sliding),
            rolling: rolling.unwrap_or(friction.rolling),
            spinning: spinning.unwrap_or(friction.spinning),
            tangential_restitution: tangential_restitution
                .unwrap_or(friction.tangential_restitution),
            ..*friction
        };
    }

    fn validate(&self) -> Result<(), InvalidValue> {
        let [first, second] = self.materials;
        let is_some = first > 0 && second > 0;
        validate::require(is_some, "materials", "> 0 each", format!("[{first}, {second}]"))?;
        if let Some(restitution) = self.restitution {
            validate::unit_interval("restitution", restitution)?;
        }
        self.restitution_law.map_or(Ok(()), |law| law.validate())?;
        let is_known = NON_ADDITIVITIES.contains(&self.non_additivity);
        let requirement = "from -0.9 to 9";
        validate::require(is_known, "non_additivity", requirement, self.non_additivity)?;
        let is_possible = self.non_additivity == 0.0 || !self.friction.acts();
        let requirement = "0 beside a friction of the pair";
        validate::require(is_possible, "non_additivity", requirement, self.non_additivity)?;
        self.friction.validate()
    }
}

/// All pairs of a world, in a table by both materials.
#[derive(Debug, Educe, Default, PartialEq)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct MaterialPairs {
    list: Vec<MaterialPair>,
    /// Number of the pair, by the first material, then the second: one more than the index in the
    /// list, 0 for no pair.
    table: Vec<u16>,
    /// Largest material, plus one.
    side: usize,
    /// Where spheres touch.
    pub non_additivity: NonAdditivity,
}

impl MaterialPairs {
    /// Makes the table.
    ///
    /// # Errors
    /// [`InvalidValue`] for an invalid number or a pair that is given twice.
    pub fn new(list: Vec<MaterialPair>) -> Result<Self, InvalidValue> {
        let most = list.iter().flat_map(|pair| pair.materials).max();
        let side = most.map_or(0, |most| usize::from(most) + 1);
        let mut table = vec![0; side * side];
        for (number, pair) in (1..).zip(&list) {
            pair.validate()?;
            let [first, second] = pair.materials.map(usize::from);
            let is_new = table[first * side + second] == 0;
            let pair = format!("[{first}, {second}]");
            validate::require(is_new, "materials", "of one pair only", pair)?;
            table[first * side + second] = number;
            table[second * side + first] = number;
        }
        let parameters = list.iter().map(|pair| (pair.materials, pair.non_additivity));
        let non_additivity = NonAdditivity::of(parameters, side);
        Ok(Self { list, table, side, non_additivity })
    }

    pub fn list(&self) -> &[MaterialPair] {
        &self.list
    }

    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Whether no pair has a restitution of its own other than 1.
    pub fn are_elastic(&self) -> bool {
        let mut given = self.list.iter().filter_map(MaterialPair::contact_restitution);
        given.all(|restitution| restitution.is_elastic())
    }

    /// The pair of two materials, 0 for none.
    #[inline]
    pub fn of(&self, materials: [u8; 2]) -> Option<&MaterialPair> {
        let [first, second] = materials.map(usize::from);
        if first >= self.side || second >= self.side {
            return None;
        }
        let number = usize::from(self.table[first * self.side + second]);
        self.list.get(number.wrapping_sub(1))
    }
}
