// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/graphcut/max_flow.h"

// The only place that uses libmaxflow (GPL-3.0-or-later, Kolmogorov and Boykov).
#include <maxflow.h>

#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>

#include "common/cells/interfaces.h"

namespace roomcut::graphcut {

namespace {

using Graph = maxflow::Graph<double, double, double>;

void fail(const char* message) {
  throw std::runtime_error(std::string("max-flow: ") + message);
}

/// Capacities of faces with one cell on either side; those to the outside, which is solid, go to the empty
/// label's cost.
void add_faces(const CellComplex& complex, const EnergyTerms& terms, Graph& graph) {
  for_each_interface(complex, [&](const Interface& face) {
    const double term = (face.wall ? terms.wall : terms.level)[face.index];
    if (face.a >= 0 && face.b >= 0) {
      if (term > 0) {
        graph.add_edge(static_cast<int>(face.a), static_cast<int>(face.b), term, term);
      }
    } else {
      graph.add_tweights(static_cast<int>(face.a >= 0 ? face.a : face.b), 0.0, term);
    }
  });
}

}  // namespace

Cut minimum_cut(const CellComplex& complex, const EnergyTerms& terms) {
  const std::size_t cells = complex.cells();
  const std::size_t faces = complex.edges.size() * complex.layers() + complex.faces() * complex.levels.size();
  if (cells > static_cast<std::size_t>(std::numeric_limits<int>::max()) ||
      faces > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw std::length_error("max-flow: too many cells or faces for its graph");
  }
  // Source side = empty: it pays the capacity to the sink, the sink side that from the source.
  Graph graph(static_cast<int>(cells), static_cast<int>(faces), fail);
  graph.add_node(static_cast<int>(cells));
  for (std::size_t c = 0; c < cells; ++c) {
    graph.add_tweights(static_cast<int>(c), terms.d_solid[c], terms.d_empty[c]);
  }
  add_faces(complex, terms, graph);
  Cut cut;
  cut.flow_m3 = graph.maxflow();
  cut.label.resize(cells);
  for (std::size_t c = 0; c < cells; ++c) {
    const bool empty = graph.what_segment(static_cast<int>(c), Graph::SINK) == Graph::SOURCE;
    cut.label[c] = empty ? Label::kEmpty : Label::kSolid;
  }
  return cut;
}

}  // namespace roomcut::graphcut
