//! A symmetric positive definite matrix kept row by row from the first entry to the diagonal, and
//! its Cholesky factor in the same place (Jennings).

/// The lower half of a symmetric matrix; row i holds the columns `first[i]..=i`.
pub(super) struct Envelope {
    rows: Vec<Row>,
    entries: Vec<f64>,
}

#[derive(Clone, Copy)]
struct Row {
    first: usize,
    /// Where column 0 of the row would lie in `entries`, wrapping below 0.
    origin: usize,
}

impl Envelope {
    /// A matrix of zeros with room for all pairs of unknowns that meet in an element.
    pub(super) fn new(count: usize, elements: &[[Option<usize>; 6]]) -> Self {
        let mut first: Vec<usize> = (0..count).collect();
        for element in elements {
            let Some(lowest) = element.iter().flatten().min() else { continue };
            for &number in element.iter().flatten() {
                first[number] = first[number].min(*lowest);
            }
        }
        let mut length: usize = 0;
        let rows = first
            .into_iter()
            .enumerate()
            .map(|(i, first)| {
                let row = Row { first, origin: length.wrapping_sub(first) };
                length += i - first + 1;
                row
            })
            .collect();
        Self { rows, entries: vec![0.0; length] }
    }

    /// Products that the factor takes at most.
    pub(super) fn work(&self) -> f64 {
        self.rows.iter().enumerate().map(|(i, row)| ((i - row.first) as f64).powi(2)).sum()
    }

    /// Adds to the entry (i, j), j ≤ i.
    pub(super) fn add(&mut self, i: usize, j: usize, value: f64) {
        self.entries[self.rows[i].origin.wrapping_add(j)] += value;
    }

    /// The columns `from..to` of row i.
    fn part(&self, i: usize, from: usize, to: usize) -> &[f64] {
        let origin = self.rows[i].origin;
        &self.entries[origin.wrapping_add(from)..origin.wrapping_add(to)]
    }

    /// Solves K x = f; the matrix becomes its factor L with K = L Lᵀ.
    pub(super) fn solve(&mut self, load: &[f64]) -> Vec<f64> {
        self.factorize();
        let mut x = load.to_vec();
        for i in 0..x.len() {
            let first = self.rows[i].first;
            x[i] = (x[i] - dot(self.part(i, first, i), &x[first..i])) / self.diagonal(i);
        }
        for i in (0..x.len()).rev() {
            x[i] /= self.diagonal(i);
            let (first, xi) = (self.rows[i].first, x[i]);
            for (target, entry) in x[first..i].iter_mut().zip(self.part(i, first, i)) {
                *target -= entry * xi;
            }
        }
        x
    }

    fn diagonal(&self, i: usize) -> f64 {
        self.entries[self.rows[i].origin.wrapping_add(i)]
    }

    /// L_ij = (K_ij − Σ_k L_ik L_jk) / L_jj, row by row.
    fn factorize(&mut self) {
        for i in 0..self.rows.len() {
            let row = self.rows[i];
            for j in row.first..i {
                let from = row.first.max(self.rows[j].first);
                let sum = dot(self.part(i, from, j), self.part(j, from, j));
                let at = row.origin.wrapping_add(j);
                self.entries[at] = (self.entries[at] - sum) / self.diagonal(j);
            }
            let own = self.part(i, row.first, i);
            let sum = dot(own, own);
            let at = row.origin.wrapping_add(i);
            self.entries[at] = (self.entries[at] - sum).max(f64::MIN_POSITIVE).sqrt();
        }
    }
}

/// Σ aᵢ bᵢ in four running sums, which the compiler can keep side by side.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (a4, b4) = (a.chunks_exact(4), b.chunks_exact(4));
    let rest: f64 = a4.remainder().iter().zip(b4.remainder()).map(|(x, y)| x * y).sum();
    for (x, y) in a4.zip(b4) {
        for k in 0..4 {
            sums[k] += x[k] * y[k];
        }
    }
    rest + sums.iter().sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solution_satisfies_the_equations() {
        let elements = [
            [Some(0), Some(1), None, Some(2), None, None],
            [Some(1), Some(3), None, Some(4), None, None],
        ];
        let k = [
            [4.0, -1.0, -1.0, 0.0, 0.0],
            [-1.0, 5.0, -0.5, -1.0, -0.3],
            [-1.0, -0.5, 3.0, 0.0, 0.0],
            [0.0, -1.0, 0.0, 4.0, -1.0],
            [0.0, -0.3, 0.0, -1.0, 2.0],
        ];
        let mut matrix = Envelope::new(5, &elements);
        for (i, row) in k.iter().enumerate() {
            for (j, &entry) in row.iter().enumerate().filter(|&(j, &entry)| j <= i && entry != 0.0)
            {
                matrix.add(i, j, entry);
            }
        }
        let f = [1.0, -2.0, 0.5, 3.0, 1.5];
        let x = matrix.solve(&f);
        for i in 0..5 {
            let left: f64 = (0..5).map(|j| k[i][j] * x[j]).sum();
            assert!((left - f[i]).abs() < 1e-13, "row {i}");
        }
    }
}
