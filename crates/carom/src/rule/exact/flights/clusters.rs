//! Clusters: spheres that stay in contact with each other and with surfaces.

use educe::Educe;
use glam::DVec3;

use super::contact_work::ContactWork;
use crate::detect::contact::Bodies;

/// A side of a ring that a sphere on the axis of a surface of revolution touches.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct RingSide {
    /// The sphere and the surface.
    pub bodies: Bodies,
    /// Unit vector from the axis to the side.
    pub side: DVec3,
}

/// Spheres held together by persistent contacts. Their forces hold until `renewal` or until an event
/// of one of the spheres.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Cluster {
    /// Slots in the order of the spheres' indices. The first member has the event at which the forces are computed
    /// again.
    pub members: Vec<u32>,
    /// Contacts by their bodies, ascending.
    pub contacts: Vec<Bodies>,
    /// The sides in the contacts with rings.
    pub sides: Vec<RingSide>,
    /// When the forces of the cluster are computed again, on the world's clock \[s\].
    pub renewal: f64,
    /// Whether the spheres fly on curves with these contacts, so that no forces are held.
    pub is_curved: bool,
}

/// A cluster that is about to be made, with the effect of its contact forces.
#[derive(Debug, Clone)]
pub(crate) struct Support {
    /// Members in the order of their indices.
    pub members: Vec<Supported>,
    /// Ascending.
    pub contacts: Vec<Bodies>,
    /// The sides in the contacts with rings.
    pub sides: Vec<RingSide>,
    /// When the forces are computed again, on the world's clock \[s\].
    pub renewal: f64,
    /// Whether the spheres fly on curves with these contacts.
    pub is_curved: bool,
    /// Work of belts at the start, where friction ends slips at once \[J\].
    pub belt_work: f64,
}

/// A sphere of a cluster that is about to be made.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Supported {
    pub slot: u32,
    /// Acceleration by everything but drag \[m/s²\].
    pub acceleration: DVec3,
    /// How it turns, where friction acts: angular velocity \[rad/s\] and angular acceleration \[rad/s²\].
    pub rotation: Option<[DVec3; 2]>,
    /// Work that the contacts of the sphere do.
    pub contact_work: ContactWork,
}

impl Cluster {
    pub fn has(&self, contact: Bodies) -> bool {
        self.contacts.binary_search(&contact).is_ok()
    }

    /// The sides of a ring, as unit vectors from the axis, in the contact of two bodies; none if that is with no ring.
    pub fn sides_of(&self, bodies: Bodies) -> impl Iterator<Item = DVec3> {
        self.sides.iter().filter(move |it| it.bodies == bodies).map(|it| it.side)
    }

    /// Whether a sphere, by its index, is in contact with another one.
    pub fn touches_spheres(&self, sphere: u32) -> bool {
        let has = |contact: &Bodies| matches!(*contact, Bodies::Pair(first, second) if first == sphere || second == sphere);
        self.contacts.iter().any(has)
    }

    /// The surfaces that a sphere, by its index, is in contact with.
    pub fn surfaces_of(&self, sphere: u32) -> impl Iterator<Item = u32> {
        let first = Bodies::Surface { sphere, surface: 0 };
        let start = self.contacts.partition_point(|contact| *contact < first);
        self.contacts[start..].iter().map_while(move |contact| match *contact {
            Bodies::Surface { sphere: other, surface } if other == sphere => Some(surface),
            _ => None,
        })
    }
}

/// All clusters, by number; numbers are used again.
#[derive(Debug, Educe, Default)]
#[educe(Clone)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub(crate) struct Clusters {
    clusters: Vec<Cluster>,
    free: Vec<u32>,
    /// How many hold their forces for a time.
    held: usize,
}

impl Clusters {
    pub fn get(&self, number: u32) -> &Cluster {
        &self.clusters[number as usize]
    }

    pub fn get_mut(&mut self, number: u32) -> &mut Cluster {
        &mut self.clusters[number as usize]
    }

    pub fn add(&mut self, cluster: Cluster) -> u32 {
        self.held += usize::from(!cluster.is_curved);
        match self.free.pop() {
            Some(number) => {
                self.clusters[number as usize] = cluster;
                number
            }
            None => {
                self.clusters.push(cluster);
                self.clusters.len() as u32 - 1
            }
        }
    }

    /// Whether one holds its forces for a time.
    pub fn hold_forces(&self) -> bool {
        self.held > 0
    }

    /// The clusters that there are.
    pub fn iter(&self) -> impl Iterator<Item = &Cluster> {
        self.clusters.iter().filter(|cluster| !cluster.members.is_empty())
    }

    /// Removes a cluster, if it was not removed before.
    pub fn remove(&mut self, number: u32) {
        let cluster = &mut self.clusters[number as usize];
        if !cluster.members.is_empty() {
            self.held -= usize::from(!cluster.is_curved);
            *cluster = Cluster::default();
            self.free.push(number);
        }
    }

    /// Replaces the slot of every member by its new one.
    pub fn renumber(&mut self, new_slot: impl Fn(u32) -> u32) {
        for slot in self.clusters.iter_mut().flat_map(|cluster| &mut cluster.members) {
            *slot = new_slot(*slot);
        }
    }

    /// When the forces of a cluster are computed again, if `slot` is the member that has this event; never for
    /// other members.
    pub fn renewal_by(&self, number: u32, slot: u32) -> f64 {
        let cluster = self.get(number);
        if cluster.members.first() == Some(&slot) { cluster.renewal } else { f64::INFINITY }
    }
}
