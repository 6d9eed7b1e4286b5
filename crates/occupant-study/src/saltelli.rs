//! Blocks of points for Sobol's sensitivity indices.
//!
//! A. Saltelli et al., "Variance based sensitivity analysis of model output", Comput. Phys. Commun. 181 (2010), 259–270:
//! points of 2k dimensions give a row of A (first k) and one of B (last k). For each point in turn come A, AB₁ … ABₖ,
//! where ABᵢ is A with column i of B, then BA₁ … BAₖ if second-order indices are wanted, then B.

/// Row of a point's block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Block {
    /// A.
    A,
    /// A with one column of B.
    Ab {
        /// The column.
        parameter: usize,
    },
    /// B with one column of A.
    Ba {
        /// The column.
        parameter: usize,
    },
    /// B.
    B,
}

impl Block {
    /// The dimension of Sobol's point that gives parameter `d` of `k`.
    pub(super) fn column(self, d: usize, k: usize) -> usize {
        let from_b = match self {
            Block::A => false,
            Block::Ab { parameter } => parameter == d,
            Block::Ba { parameter } => parameter != d,
            Block::B => true,
        };
        if from_b { d + k } else { d }
    }
}

/// Runs per point.
pub(super) fn block_len(parameters: u64, second_order: bool) -> u64 {
    if second_order { 2 * parameters + 2 } else { parameters + 2 }
}

/// The point of a sample, and its row in the block.
pub(super) fn place(index: u64, parameters: usize, second_order: bool) -> (u64, Block) {
    let len = block_len(parameters as u64, second_order);
    let row = (index % len) as usize;
    let block = match row {
        0 => Block::A,
        _ if row as u64 + 1 == len => Block::B,
        _ if row <= parameters => Block::Ab { parameter: row - 1 },
        _ => Block::Ba { parameter: row - 1 - parameters },
    };
    (index / len, block)
}
