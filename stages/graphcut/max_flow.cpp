// SPDX-License-Identifier: GPL-3.0-or-later
#include "stages/graphcut/max_flow.h"

// The only place that uses libmaxflow (GPL-3.0-or-later, Kolmogorov and Boykov).
#include <maxflow.h>

#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

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

/// The faces alone. Throws std::length_error when there are more than the library can number.
std::unique_ptr<Graph> graph_of(const CellComplex& complex, const EnergyTerms& terms) {
  const std::size_t cells = complex.cells();
  const std::size_t faces = complex.edges.size() * complex.layers() + complex.faces() * complex.levels.size();
  if (cells > static_cast<std::size_t>(std::numeric_limits<int>::max()) ||
      faces > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
    throw std::length_error("max-flow: too many cells or faces for its graph");
  }
  auto graph = std::make_unique<Graph>(static_cast<int>(cells), static_cast<int>(faces), fail);
  graph->add_node(static_cast<int>(cells));
  add_faces(complex, terms, *graph);
  return graph;
}

std::vector<std::uint8_t> labels_of(Graph& graph) {
  std::vector<std::uint8_t> label(static_cast<std::size_t>(graph.get_node_num()));
  for (std::size_t c = 0; c < label.size(); ++c) {
    const bool empty = graph.what_segment(static_cast<int>(c), Graph::SINK) == Graph::SOURCE;
    label[c] = empty ? Label::kEmpty : Label::kSolid;
  }
  return label;
}

}  // namespace

Cut minimum_cut(const CellComplex& complex, const EnergyTerms& terms) {
  // Source side = empty: it pays the capacity to the sink, the sink side that from the source.
  const std::unique_ptr<Graph> graph = graph_of(complex, terms);
  for (std::size_t c = 0; c < complex.cells(); ++c) {
    graph->add_tweights(static_cast<int>(c), terms.d_solid[c], terms.d_empty[c]);
  }
  Cut cut;
  cut.flow_m3 = graph->maxflow();
  cut.label = labels_of(*graph);
  return cut;
}

struct RepeatedCut::State {
  std::unique_ptr<Graph> graph;
  std::vector<double> gain_m3;  ///< of the last cut
  bool cut = false;             ///< whether there was one
};

RepeatedCut::RepeatedCut(const CellComplex& complex, const EnergyTerms& terms)
    : state_(std::make_unique<State>(graph_of(complex, terms), std::vector<double>(complex.cells(), 0))) {}
RepeatedCut::RepeatedCut(RepeatedCut&&) noexcept = default;
RepeatedCut::~RepeatedCut() = default;

std::vector<std::uint8_t> RepeatedCut::label(const std::vector<double>& gain_m3) {
  Graph& graph = *state_->graph;
  const auto sign = [](double value) { return static_cast<int>(value > 0) - static_cast<int>(value < 0); };
  // What is left of a cell's capacity after a flow grows by as much as the capacity does. The search trees of
  // the last cut must know where its sign changes.
  for (std::size_t c = 0; c < gain_m3.size(); ++c) {
    const auto node = static_cast<int>(c);
    const double before = graph.get_trcap(node);
    const double after = before + (gain_m3[c] - state_->gain_m3[c]);
    graph.set_trcap(node, after);
    if (state_->cut && sign(after) != sign(before)) {
      graph.mark_node(node);
    }
  }
  state_->gain_m3 = gain_m3;
  graph.maxflow(std::exchange(state_->cut, true));
  return labels_of(graph);
}

}  // namespace roomcut::graphcut
