//! Who meets at which edge, before the surface is known to be manifold.

/// Items sorted into numbered buckets by counting: two passes, no hashing, order of arrival kept.
#[derive(Debug)]
pub(super) struct Buckets {
    starts: Vec<u32>,
    items: Vec<u32>,
}

impl Buckets {
    pub(super) fn new(buckets: usize) -> Self {
        Self { starts: vec![0; buckets + 2], items: Vec::new() }
    }

    /// First pass: one more item will go into `bucket`.
    pub(super) fn count(&mut self, bucket: usize) {
        self.starts[bucket + 2] += 1;
    }

    pub(super) fn finish_counting(&mut self) {
        for b in 2..self.starts.len() {
            self.starts[b] += self.starts[b - 1];
        }
        self.items = vec![0; *self.starts.last().unwrap_or(&0) as usize];
    }

    /// Second pass: puts `item` into `bucket`.
    pub(super) fn put(&mut self, bucket: usize, item: u32) {
        let slot = &mut self.starts[bucket + 1];
        self.items[*slot as usize] = item;
        *slot += 1;
    }

    /// What is in `bucket`, in order of arrival.
    pub(super) fn bucket(&self, bucket: usize) -> &[u32] {
        &self.items[self.starts[bucket] as usize..self.starts[bucket + 1] as usize]
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &[u32]> {
        self.starts.windows(2).map(|w| &self.items[w[0] as usize..w[1] as usize])
    }
}

/// The half-edges over each undirected edge of a triangle soup.
///
/// A half-edge is numbered `3 * triangle + side`.
#[derive(Debug)]
pub(super) struct EdgeGroups {
    buckets: Buckets,
}

impl EdgeGroups {
    pub(super) fn new(triangles: &[[u32; 3]], vertex_count: usize) -> Self {
        let mut buckets = Buckets::new(vertex_count);
        for_each_edge(triangles, |lo, _, _| buckets.count(lo as usize));
        buckets.finish_counting();
        for_each_edge(triangles, |lo, _, h| buckets.put(lo as usize, h));
        Self { buckets }
    }

    /// Calls `visit` once for each edge with all half-edges over it, in ascending order.
    pub(super) fn for_each(&self, triangles: &[[u32; 3]], mut visit: impl FnMut(&[u32])) {
        let mut sorted: Vec<(u32, u32)> = Vec::new();
        let mut group: Vec<u32> = Vec::new();
        for bucket in self.buckets.iter() {
            sorted.clear();
            sorted.extend(bucket.iter().map(|&h| {
                let (a, b) = ends(triangles, h);
                (a.max(b), h)
            }));
            sorted.sort_unstable();
            for run in sorted.chunk_by(|x, y| x.0 == y.0) {
                group.clear();
                group.extend(run.iter().map(|&(_, h)| h));
                visit(&group);
            }
        }
    }
}

/// Start and end vertex of a half-edge.
pub(super) fn ends(triangles: &[[u32; 3]], h: u32) -> (u32, u32) {
    let t = &triangles[h as usize / 3];
    (t[h as usize % 3], t[(h as usize + 1) % 3])
}

fn for_each_edge(triangles: &[[u32; 3]], mut visit: impl FnMut(u32, u32, u32)) {
    for h in 0..3 * triangles.len() as u32 {
        let (a, b) = ends(triangles, h);
        visit(a.min(b), a.max(b), h);
    }
}
