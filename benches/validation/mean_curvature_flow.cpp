// SPDX-License-Identifier: MIT OR Apache-2.0
// The curve skeleton of a closed mesh by mean curvature flow, as CGAL has it.
//
//   mean_curvature_flow MESH.off SKELETON.obj W_H W_M
//
// W_H: speed of the contraction, W_M: attraction to the medial axis (thesis §4.3.1.2). Prints the
// processor time of the skeletonization in seconds.
#include <CGAL/Mean_curvature_flow_skeletonization.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/IO/polygon_mesh_io.h>

#include <boost/graph/graph_traits.hpp>

#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iostream>

using Mesh = CGAL::Surface_mesh<CGAL::Simple_cartesian<double>::Point_3>;
using Flow = CGAL::Mean_curvature_flow_skeletonization<Mesh>;

int main(int argc, char** argv) {
  Mesh mesh;
  if (argc != 5 || !CGAL::IO::read_polygon_mesh(argv[1], mesh)) {
    std::cerr << "usage: mean_curvature_flow MESH.off SKELETON.obj W_H W_M\n";
    return 1;
  }
  const std::clock_t start = std::clock();
  Flow flow(mesh);
  // CGAL's trade-off is the inverse of the speed of the thesis's tool.
  flow.set_quality_speed_tradeoff(std::atof(argv[3]));
  flow.set_medially_centered_speed_tradeoff(std::atof(argv[4]));
  flow.contract_until_convergence();
  Flow::Skeleton skeleton;
  flow.convert_to_skeleton(skeleton);
  std::cout << double(std::clock() - start) / CLOCKS_PER_SEC << "\n";

  std::ofstream out(argv[2]);
  out.precision(17);
  for (auto v : CGAL::make_range(vertices(skeleton))) {
    const auto& p = skeleton[v].point;
    out << "v " << p.x() << " " << p.y() << " " << p.z() << "\n";
  }
  for (auto e : CGAL::make_range(edges(skeleton)))
    out << "l " << source(e, skeleton) + 1 << " " << target(e, skeleton) + 1 << "\n";
  return out ? 0 : 1;
}
