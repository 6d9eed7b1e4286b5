//! Joints as data: viscous dampers, stops and elastic springs.
//!
//! Report: "The Viscous Damper", "Joint Stops" (Figs 9–11), "Potential Energy due to Spinal Elasticity".

use std::ops::Index;

use crate::body::{Joint, Tree};
use crate::forces::joint::limit::Limits;
use crate::forces::joint::muscle::Muscle;

/// Stiffness up to which a neck's spring leaves the moment to its limit, N·m/rad: half of a dummy's.
const SOFT_NECK_N_M_RAD: f64 = 20.0;

/// Damping that rises towards a limit of travel (Figs 9–11): from the joint's normal damping at `begin_rad` linearly to
/// `damping_n_m_s` at `full_rad`, constant beyond, and only while the joint moves towards the limit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stop {
    /// β_N or α_N.
    pub begin_rad: f64,
    /// β_S or α_S. Above `begin_rad` for an upper stop, below it for a hinge's lower stop.
    pub full_rad: f64,
    /// J_S, N·m·s/rad.
    pub damping_n_m_s: f64,
}

/// Rotational spring in β: V = ½ K (β − β₀)².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AngularSpring {
    /// K, N·m/rad.
    pub stiffness_n_m: f64,
    /// β₀; `None` takes the joint's angle at the start of the run.
    pub rest_rad: Option<f64>,
}

/// A ball joint; β is the angle between the Z axes of the two segments.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BallJoint {
    /// J_N, N·m·s/rad.
    pub damping_n_m_s: f64,
    /// J_t, damping of rotation about the distal segment's Z; 0 in the report.
    pub twist_damping_n_m_s: f64,
    /// Limit of β.
    pub stop: Option<Stop>,
    /// Spring; in the report, in the two back joints.
    pub spring: Option<AngularSpring>,
}

/// Elbow or knee; α is the rotation of the distal segment about the common Y axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HingeJoint {
    /// J_N, N·m·s/rad.
    pub damping_n_m_s: f64,
    /// Stop while α falls.
    pub lower_stop: Option<Stop>,
    /// Stop while α rises.
    pub upper_stop: Option<Stop>,
}

/// Law of a joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointLaw {
    /// Ball joint.
    Ball(BallJoint),
    /// Hinge.
    Hinge(HingeJoint),
}

impl From<BallJoint> for JointLaw {
    fn from(ball: BallJoint) -> Self {
        JointLaw::Ball(ball)
    }
}

impl From<HingeJoint> for JointLaw {
    fn from(hinge: HingeJoint) -> Self {
        JointLaw::Hinge(hinge)
    }
}

impl JointLaw {
    /// Law of a ball joint.
    pub fn ball(&self) -> Option<&BallJoint> {
        match self {
            JointLaw::Ball(ball) => Some(ball),
            JointLaw::Hinge(_) => None,
        }
    }

    /// Law of a hinge.
    pub fn hinge(&self) -> Option<&HingeJoint> {
        match self {
            JointLaw::Hinge(hinge) => Some(hinge),
            JointLaw::Ball(_) => None,
        }
    }
}

/// Laws of the joints of a body; each is of the tree's kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Joints {
    tree: &'static Tree,
    laws: Vec<JointLaw>,
    /// Elastic limits, dry friction and locks, in the tree's order.
    pub limits: Vec<Limits>,
    /// Muscles, in the tree's order.
    pub muscles: Vec<Muscle>,
    /// ε that keeps β differentiable where the two Z axes are parallel; 0 gives the report's formula.
    pub epsilon: f64,
}

impl Joints {
    /// Default of ε.
    pub const EPSILON: f64 = 1e-3;

    /// Free joints: no damping, no stop, no spring.
    pub fn free(tree: &'static Tree) -> Self {
        Joints::alike(tree, BallJoint::default(), HingeJoint::default())
    }

    /// One law for all ball joints, and one for all hinges.
    pub fn alike(tree: &'static Tree, ball: BallJoint, hinge: HingeJoint) -> Self {
        let law = |joint: Joint| if tree[joint].is_hinge() { hinge.into() } else { ball.into() };
        let laws = tree.joints().map(law).collect();
        Joints { tree, laws, limits: Vec::new(), muscles: Vec::new(), epsilon: Joints::EPSILON }
    }

    /// Laws of the joints of a tree that is part of this one.
    pub fn of_tree(self, tree: &'static Tree) -> Self {
        if std::ptr::eq(self.tree, tree) {
            return self;
        }
        let of = |joint: Joint| tree.joint_named(self.tree[joint].name);
        let law = |joint: Joint| self.tree.joint_named(tree[joint].name).map(|whole| self.laws[whole.index()]);
        Joints {
            tree,
            laws: tree.joints().filter_map(law).collect(),
            limits: self.limits.iter().filter_map(|l| Some(Limits { joint: of(l.joint)?, ..l.clone() })).collect(),
            muscles: self.muscles.iter().filter_map(|m| Some(Muscle { joint: of(m.joint)?, ..*m })).collect(),
            epsilon: self.epsilon,
        }
    }

    /// Laws of several bodies, whose tree is `tree`; ε is that of the first.
    pub(crate) fn together<'a>(tree: &'static Tree, all: impl Iterator<Item = &'a Joints>) -> Self {
        let mut sum = Joints { laws: Vec::new(), ..Joints::free(tree) };
        for (i, joints) in all.enumerate() {
            let first = sum.laws.len();
            let moved = |joint: Joint| tree.joint(first + joint.index());
            sum.laws.extend(&joints.laws);
            sum.limits.extend(joints.limits.iter().map(|l| Limits { joint: moved(l.joint), ..l.clone() }));
            sum.muscles.extend(joints.muscles.iter().map(|m| Muscle { joint: moved(m.joint), ..*m }));
            if i == 0 {
                sum.epsilon = joints.epsilon;
            }
        }
        sum
    }

    /// Joints with another law in one joint; a law of the other kind, or a joint that the tree lacks, changes nothing.
    #[must_use]
    pub fn with(mut self, joint: Joint, law: impl Into<JointLaw>) -> Self {
        let law = law.into();
        if let Some(own) = self.laws.get_mut(joint.index()).filter(|own| own.hinge().is_some() == law.hinge().is_some())
        {
            *own = law;
        }
        self
    }

    /// Joints with another ε.
    #[must_use]
    pub fn with_epsilon(self, epsilon: f64) -> Self {
        Joints { epsilon, ..self }
    }

    /// Whether any joint has an elastic limit or dry friction.
    pub fn has_limits(&self) -> bool {
        !self.limits.is_empty()
    }

    /// Whether the neck of a body is one joint that has the limit of one of two neck joints, and no stiff spring.
    pub(crate) fn is_half_a_neck(&self) -> bool {
        let marks = self.tree.landmarks();
        let is_alone = |joint: &Joint| Some(self.tree[*joint].proximal) == marks.chest;
        let Some(neck) = marks.neck.filter(is_alone) else { return false };
        let has_spring = self[neck].ball().is_some_and(|ball| ball.spring.is_some());
        let mut own = self.limits.iter().filter(|limits| limits.joint == neck);
        let is_soft = |limits: &Limits| limits.lock.is_none_or(|lock| lock.stiffness < SOFT_NECK_N_M_RAD);
        !has_spring && own.any(|limits| is_soft(limits) && limits.is_of_half_a_neck())
    }

    /// Tree of the joints.
    pub fn tree(&self) -> &'static Tree {
        self.tree
    }

    /// All joints with their laws, in the tree's order.
    pub fn iter(&self) -> impl Iterator<Item = (Joint, &JointLaw)> {
        self.tree.joints().zip(&self.laws)
    }

    /// Mutable law of a ball joint; none for a hinge, or a joint that the tree lacks.
    pub fn ball_mut(&mut self, joint: Joint) -> Option<&mut BallJoint> {
        match self.laws.get_mut(joint.index())? {
            JointLaw::Ball(ball) => Some(ball),
            JointLaw::Hinge(_) => None,
        }
    }

    /// Mutable law of a hinge; none for a ball joint, or a joint that the tree lacks.
    pub fn hinge_mut(&mut self, joint: Joint) -> Option<&mut HingeJoint> {
        match self.laws.get_mut(joint.index())? {
            JointLaw::Hinge(hinge) => Some(hinge),
            JointLaw::Ball(_) => None,
        }
    }
}

impl Index<Joint> for Joints {
    type Output = JointLaw;

    fn index(&self, joint: Joint) -> &JointLaw {
        &self.laws[joint.index()]
    }
}
