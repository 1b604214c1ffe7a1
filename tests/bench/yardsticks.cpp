// SPDX-License-Identifier: GPL-3.0-or-later
// usage: bench_yardsticks SCAN.ply [read|normals]: what others take for the first step, to measure roomcut
// against on any machine: CGAL's PLY reader, and its PCA normals from the 16 nearest neighbours in a kd-tree,
// on one thread, points in file order. Prints processor seconds as JSON.
#include <CGAL/IO/read_ply_points.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/pca_estimate_normals.h>
#include <CGAL/property_map.h>
#include <sys/resource.h>

#include <fstream>
#include <iostream>
#include <string>
#include <utility>
#include <vector>

namespace {

using Kernel = CGAL::Simple_cartesian<float>;
using Point = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Position = CGAL::First_of_pair_property_map<Point>;
using Normal = CGAL::Second_of_pair_property_map<Point>;
constexpr unsigned kNeighbours = 16;

double processor_seconds() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: bench_yardsticks SCAN.ply [read|normals]\n";
    return 2;
  }
  const bool normals = argc < 3 || std::string(argv[2]) == "normals";
  std::vector<Point> points;
  std::ifstream file(argv[1], std::ios::binary);
  const double begin = processor_seconds();
  if (!CGAL::IO::read_PLY(file, std::back_inserter(points), CGAL::parameters::point_map(Position()))) {
    std::cerr << argv[1] << ": CGAL cannot read it\n";
    return 3;
  }
  const double read = processor_seconds();
  std::cout << "{\"points\": " << points.size() << ", \"cgal_read_s\": " << read - begin;
  if (normals) {
    CGAL::pca_estimate_normals<CGAL::Sequential_tag>(
        points, kNeighbours, CGAL::parameters::point_map(Position()).normal_map(Normal()));
    std::cout << ", \"kd_normals_s\": " << processor_seconds() - read;
  }
  std::cout << "}\n";
  return 0;
}
