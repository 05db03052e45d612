//! Known mistakes: named variants of the course's rule.

use serde::{Serialize, Serializer};

use crate::error::GradeError;

/// A mistake in a student's program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum Mistake {
    /// `x += h v`, then `v += h a`.
    ExplicitEuler,
    /// The position moves with the velocity saved before the last response to a collision.
    OldVelocity,
    /// The position moves with the mean of the old and the new velocity.
    MeanVelocity,
    /// The force is used as acceleration, without division by the mass.
    MassIgnored,
    /// No drag.
    NoDrag,
    /// Drag along the velocity.
    DragSign,
    /// Drag uses the velocity of the emission.
    DragNotUpdated,
    /// Drag uses the velocity of the previous frame.
    DragLate,
    /// Drag grows with the square of the velocity.
    DragQuadratic,
    /// Forces of all frames add up.
    ForcesNotCleared,
    /// The whole reflected velocity is multiplied by the restitution.
    RestitutionOfWhole,
    /// The velocity is reversed and multiplied by the restitution.
    VelocityReversed,
    /// The square root of the restitution is used.
    RestitutionSqrt,
    /// The square of the restitution is used.
    RestitutionSquared,
    /// The restitution is taken as 1.
    RestitutionIgnored,
    /// `e` is used in place of `1 + e`.
    OneForgotten,
    /// Balls that move away from a collider bounce, too.
    NoEnteringTest,
    /// At edges and corners, the normal of the plane is used.
    EdgeNormalOfPlane,
    /// At edges and corners, the direction from the middle of the plane is used.
    EdgeNormalFromCentre,
    /// There is no contact if the centre of the ball is not above the plane.
    EdgesIgnored,
    /// Contacts occur from underneath, too.
    FromUnderneath,
    /// Planes are infinite.
    ExtentIgnored,
    /// Width and height of a plane are exchanged.
    ExtentSwapped,
    /// The whole width and height are used in place of half of them.
    ExtentDoubled,
    /// The ball is a point.
    RadiusIgnored,
    /// The diameter is used in place of the radius.
    DiameterForRadius,
    /// A ball that overlaps the plane is not moved out.
    NotOnTop,
    /// A ball that overlaps a fixed sphere is moved out, too.
    OnTopOfSpheres,
    /// The normal is not transformed from the collider's coordinate system.
    NormalNotTransformed,
    /// The new velocity is not transformed from the collider's coordinate system.
    VelocityNotTransformed,
    /// Degrees of a collider's rotation are taken for radians.
    DegreesForRadians,
    /// Collisions are answered before the movement of the frame.
    CollisionsBefore,
    /// Only the first collider that a ball touches in a frame is answered.
    FirstColliderOnly,
    /// No ball is emitted once all slots are full.
    RingStops,
    /// The newest ball is replaced in place of the oldest.
    RingNewest,
    /// A ball that is reused keeps its velocity.
    RingKeepsVelocity,
    /// Frames are those of the display, each with its own length.
    DisplayFrames,
    /// Frames are fixed, but balls move by the frame time of the display.
    DisplayStep,
}

use Mistake::*;

/// Texts about a mistake.
struct Entry {
    mistake: Mistake,
    /// Name on the command line.
    name: &'static str,
    /// What the program does, in a sentence.
    sentence: &'static str,
    /// The wrong formula.
    wrong: &'static str,
    /// The formula of the lecture.
    right: &'static str,
}

const fn entry(
    mistake: Mistake,
    name: &'static str,
    sentence: &'static str,
    [wrong, right]: [&'static str; 2],
) -> Entry {
    Entry { mistake, name, sentence, wrong, right }
}

/// All mistakes, in the order of their declaration.
const ENTRIES: [Entry; 38] = [
    entry(
        ExplicitEuler,
        "explicit-euler",
        "The position is updated with the old velocity, before the velocity (explicit Euler).",
        ["x' = x + h v; v' = v + h F/m", "v' = v + h F/m; x' = x + h v'"],
    ),
    entry(
        OldVelocity,
        "old-velocity",
        "The position is updated with a saved velocity, from before the last bounce.",
        ["x' = x + h v_saved", "x' = x + h v', v' the velocity after all bounces so far"],
    ),
    entry(
        MeanVelocity,
        "mean-velocity",
        "The position is updated with the mean of the old and the new velocity.",
        ["x' = x + h (v + v')/2", "x' = x + h v'"],
    ),
    entry(
        MassIgnored,
        "mass-ignored",
        "The force is not divided by the mass.",
        ["v' = v + h F", "v' = v + h F/m"],
    ),
    entry(NoDrag, "no-drag", "There is no viscous drag.", ["F = F_const", "F = F_const - k v"]),
    entry(
        DragSign,
        "drag-sign",
        "Drag has the wrong sign: it speeds the ball up.",
        ["F = F_const + k v", "F = F_const - k v"],
    ),
    entry(
        DragNotUpdated,
        "drag-not-updated",
        "Drag is computed once, when the ball is emitted, and never again.",
        ["F = F_const - k v_emitted", "F = F_const - k v, anew in each frame"],
    ),
    entry(
        DragLate,
        "drag-late",
        "Drag is one frame late: it is computed from the velocity of the frame before.",
        ["F = F_const - k v_before", "F = F_const - k v"],
    ),
    entry(
        DragQuadratic,
        "drag-quadratic",
        "Drag grows with the square of the velocity, not with the velocity.",
        ["F = F_const - k |v| v", "F = F_const - k v"],
    ),
    entry(
        ForcesNotCleared,
        "forces-not-cleared",
        "Forces are not cleared: those of all frames so far add up.",
        ["F' = F + F_const - k v", "F' = F_const - k v"],
    ),
    entry(
        RestitutionOfWhole,
        "restitution-whole",
        "Restitution scales the whole reflected velocity, not only its normal part.",
        ["v' = e (v - 2 (v.n) n)", "v' = v - (1 + e) (v.n) n"],
    ),
    entry(
        VelocityReversed,
        "velocity-reversed",
        "The velocity is turned round as a whole, instead of only its normal part.",
        ["v' = -e v", "v' = v - (1 + e) (v.n) n"],
    ),
    entry(
        RestitutionSqrt,
        "restitution-sqrt",
        "The root of the restitution is used (as if it were one of energies).",
        ["v' = v - (1 + sqrt(e)) (v.n) n", "v' = v - (1 + e) (v.n) n"],
    ),
    entry(
        RestitutionSquared,
        "restitution-squared",
        "The square of the restitution is used: it is applied twice.",
        ["v' = v - (1 + e^2) (v.n) n", "v' = v - (1 + e) (v.n) n"],
    ),
    entry(
        RestitutionIgnored,
        "restitution-ignored",
        "Restitution is ignored: every bounce is elastic.",
        ["v' = v - 2 (v.n) n", "v' = v - (1 + e) (v.n) n"],
    ),
    entry(
        OneForgotten,
        "one-forgotten",
        "The normal velocity is taken out e times instead of 1 + e times: the ball sinks in.",
        ["v' = v - e (v.n) n", "v' = v - (1 + e) (v.n) n"],
    ),
    entry(
        NoEnteringTest,
        "no-entering-test",
        "The program does not test whether the ball is entering: one that leaves is turned back.",
        ["contact: answered always", "contact: answered only if v.n < 0"],
    ),
    entry(
        EdgeNormalOfPlane,
        "edge-normal-of-plane",
        "At edges and corners the normal is that of the plane.",
        ["n = (0, 1, 0) at edges, too", "n = (l - q)/|l - q|, q on the edge or corner"],
    ),
    entry(
        EdgeNormalFromCentre,
        "edge-normal-from-centre",
        "At edges and corners the normal points from the middle of the plane to the ball.",
        ["n = l/|l|", "n = (l - q)/|l - q|, q on the edge or corner"],
    ),
    entry(
        EdgesIgnored,
        "edges-ignored",
        "There is no contact with edges and corners, only with the face.",
        ["contact: |l.x| <= w/2, |l.z| <= h/2, l.y <= r", "contact: |l - q| <= r"],
    ),
    entry(
        FromUnderneath,
        "from-underneath",
        "Balls collide with planes from underneath, too.",
        ["contact: |l - q| <= r", "contact: |l - q| <= r and l.y >= 0"],
    ),
    entry(
        ExtentIgnored,
        "extent-ignored",
        "Planes have no end: their width and height are ignored.",
        ["q = (l.x, 0, l.z)", "q = (clamp(l.x, w/2), 0, clamp(l.z, h/2))"],
    ),
    entry(
        ExtentSwapped,
        "extent-swapped",
        "Width and height of planes are swapped.",
        ["q = (clamp(l.x, h/2), 0, clamp(l.z, w/2))", "q = (clamp(l.x, w/2), 0, clamp(l.z, h/2))"],
    ),
    entry(
        ExtentDoubled,
        "extent-doubled",
        "Planes are twice as wide and high: the whole width is used for half of it.",
        ["q = (clamp(l.x, w), 0, clamp(l.z, h))", "q = (clamp(l.x, w/2), 0, clamp(l.z, h/2))"],
    ),
    entry(
        RadiusIgnored,
        "radius-ignored",
        "The radius of the ball is ignored: it collides with its centre.",
        ["contact: |l - q| <= 0, |x - c| < R", "contact: |l - q| <= r, |x - c| < R + r"],
    ),
    entry(
        DiameterForRadius,
        "diameter-for-radius",
        "The diameter (the scale of the sphere) is used for the radius of the ball.",
        ["contact: |l - q| <= 2 r, |x - c| < R + 2 r", "contact: |l - q| <= r, |x - c| < R + r"],
    ),
    entry(
        NotOnTop,
        "not-on-top",
        "The ball is not put on top of the plane at a collision: it sinks in.",
        ["x' = x", "x' = q + r n"],
    ),
    entry(
        OnTopOfSpheres,
        "on-top-of-spheres",
        "The ball is put on top of fixed spheres, too, not only of planes.",
        ["sphere: x' = c + (R + r) n", "sphere: x' = x"],
    ),
    entry(
        NormalNotTransformed,
        "normal-not-transformed",
        "The normal is not transformed to the world: it stays in the collider's local frame.",
        ["v' = v - (1 + e) (v.n_local) n_local", "v' = v - (1 + e) (v.n) n, n = R n_local"],
    ),
    entry(
        VelocityNotTransformed,
        "velocity-not-transformed",
        "The new velocity is not transformed to the world: it stays in the local frame.",
        ["v' = v'_local", "v' = R v'_local (TransformDirection)"],
    ),
    entry(
        DegreesForRadians,
        "degrees-for-radians",
        "The angles of the colliders are in degrees, but are used as radians.",
        ["R = rotation by the number of degrees, in radians", "R = rotation by the angle"],
    ),
    entry(
        CollisionsBefore,
        "collisions-before",
        "Collisions are answered before the ball is moved, not after.",
        ["frame: collide, then integrate", "frame: integrate, then collide"],
    ),
    entry(
        FirstColliderOnly,
        "first-collider-only",
        "Only the first collider that a ball meets in a frame is answered.",
        ["stop after one collision", "each collider in order, on what the ones before left"],
    ),
    entry(
        RingStops,
        "ring-stops",
        "No ball is emitted any more once there are maxSpheres.",
        ["stop at maxSpheres", "ball k takes the slot k mod maxSpheres"],
    ),
    entry(
        RingNewest,
        "ring-newest",
        "Once there are maxSpheres, the newest ball is used again, not the oldest.",
        ["ball k takes the last slot", "ball k takes the slot k mod maxSpheres"],
    ),
    entry(
        RingKeepsVelocity,
        "ring-keeps-velocity",
        "A ball that is used again keeps its velocity.",
        ["x' = x_emitter", "x' = x_emitter, v' = v_emitter"],
    ),
    entry(
        DisplayFrames,
        "display-frames",
        "The physics runs in the frames of the display (Update), not in fixed ones (FixedUpdate).",
        ["h = time since the last picture", "h = 0.02 s, the fixed frame time"],
    ),
    entry(
        DisplayStep,
        "display-step",
        "Fixed frames move the balls by the frame time of the display, 1/60 s.",
        ["h = 1/60 s, every 0.02 s", "h = 0.02 s, every 0.02 s"],
    ),
];

impl Mistake {
    /// Returns all mistakes.
    pub fn all() -> impl ExactSizeIterator<Item = Self> {
        ENTRIES.iter().map(|entry| entry.mistake)
    }

    /// Finds a mistake by name.
    ///
    /// # Errors
    /// [`GradeError::UnknownMistake`] with the most similar name.
    pub fn named(name: &str) -> Result<Self, GradeError> {
        let found = ENTRIES.iter().find(|entry| entry.name == name).map(|entry| entry.mistake);
        found.ok_or_else(|| GradeError::UnknownMistake {
            name: name.to_owned(),
            nearest: nearest(name),
        })
    }

    /// Name on the command line.
    pub fn name(self) -> &'static str {
        self.entry().name
    }

    /// Returns a sentence for the author that says what the program does.
    pub fn sentence(self) -> &'static str {
        self.entry().sentence
    }

    /// The formula of the program.
    pub fn wrong(self) -> &'static str {
        self.entry().wrong
    }

    /// The formula of the lecture.
    pub fn right(self) -> &'static str {
        self.entry().right
    }

    fn entry(self) -> &'static Entry {
        &ENTRIES[self as usize]
    }
}

impl Serialize for Mistake {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

/// Most similar name, if one is similar.
fn nearest(name: &str) -> Option<&'static str> {
    let likeness = |own: &str| strsim::jaro_winkler(own, name);
    let names = ENTRIES.iter().map(|entry| entry.name);
    let best = names.max_by(|a, b| likeness(a).total_cmp(&likeness(b)))?;
    (likeness(best) > 0.75).then_some(best)
}

/// The set of mistakes of one program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct Mistakes(u64);

impl Mistakes {
    /// No mistakes: the course's rule.
    pub const NONE: Self = Self(0);

    /// Whether the program makes this mistake.
    pub fn has(self, mistake: Mistake) -> bool {
        self.0 & (1 << mistake as u64) != 0
    }

    /// Adds a mistake to the set.
    #[must_use]
    pub fn with(self, mistake: Mistake) -> Self {
        Self(self.0 | (1 << mistake as u64))
    }

    /// Iterates over the mistakes.
    pub fn iter(self) -> impl Iterator<Item = Mistake> {
        Mistake::all().filter(move |it| self.has(*it))
    }

    /// Number of mistakes.
    pub fn len(self) -> usize {
        self.0.count_ones() as usize
    }

    /// Whether the set is empty.
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }
}

impl From<Mistake> for Mistakes {
    fn from(mistake: Mistake) -> Self {
        Self::NONE.with(mistake)
    }
}

impl FromIterator<Mistake> for Mistakes {
    fn from_iter<I: IntoIterator<Item = Mistake>>(mistakes: I) -> Self {
        mistakes.into_iter().fold(Self::NONE, Self::with)
    }
}

impl std::fmt::Display for Mistakes {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.is_empty() {
            return f.write_str("the course's rule");
        }
        let names: Vec<&str> = self.iter().map(Mistake::name).collect();
        f.write_str(&names.join(" + "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_are_in_the_order_of_the_declaration_and_found_by_name() {
        for (number, entry) in ENTRIES.iter().enumerate() {
            assert_eq!(entry.mistake as usize, number, "{}", entry.name);
            assert_eq!(Mistake::named(entry.name).unwrap(), entry.mistake);
        }
    }

    #[test]
    fn a_mistyped_name_leads_to_a_similar_one() {
        let error = Mistake::named("restitution-square").unwrap_err().to_string();
        assert!(error.contains("did you mean \"restitution-squared\"?"), "{error}");
        assert_eq!(nearest("xyz"), None);
    }
}
