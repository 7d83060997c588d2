//! What holds the particles of a shell.

use crate::state::ShellState;
use glam::DVec3;

/// What a support leaves free of a vector.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Hold {
    /// All of it.
    #[default]
    Free,
    /// Nothing.
    Fixed,
    /// What lies across this unit vector.
    Across(DVec3),
    /// What lies along this unit vector.
    Along(DVec3),
}

impl Hold {
    /// What it leaves of `v`.
    #[inline(always)]
    pub fn of(self, v: DVec3) -> DVec3 {
        match self {
            Self::Free => v,
            Self::Fixed => DVec3::ZERO,
            Self::Across(n) => v - v.dot(n) * n,
            Self::Along(n) => v.dot(n) * n,
        }
    }

    pub(crate) fn unit(self) -> Option<Self> {
        let unit = |n: DVec3| n.try_normalize();
        match self {
            Self::Free | Self::Fixed => Some(self),
            Self::Across(n) => unit(n).map(Self::Across),
            Self::Along(n) => unit(n).map(Self::Along),
        }
    }
}

/// Support of particles: what they may do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Support {
    /// Where the mid-surface may go.
    pub displacement: Hold,
    /// How the director may turn.
    pub director: Hold,
}

impl Support {
    /// Neither moves nor turns. Put the first row on the line of the clamp, and hold all rows within 2h behind it.
    pub const CLAMPED: Self = Self { displacement: Hold::Fixed, director: Hold::Fixed };
    /// Turns, but does not move. Put the row on the line of the support, with half its area.
    pub const SIMPLE: Self = Self { displacement: Hold::Fixed, director: Hold::Free };

    /// Slides on a plane of symmetry with this normal; directors stay in it.
    pub fn sliding(normal: DVec3) -> Self {
        Self { displacement: Hold::Across(normal), director: Hold::Across(normal) }
    }

    /// Moves along a direction and turns freely, as on a thin diaphragm across it.
    pub fn diaphragm(direction: DVec3) -> Self {
        Self { displacement: Hold::Along(direction), director: Hold::Free }
    }
}

/// Support with the number `support` of a list.
#[inline(always)]
pub(crate) fn numbered(support: i32, supports: &[Support]) -> Support {
    if support == ShellState::FREE { Support::default() } else { supports[support as usize] }
}
