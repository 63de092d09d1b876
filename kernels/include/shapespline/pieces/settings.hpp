// What a search for pieces is asked for, and what it may spend.
#pragma once

#include "shapespline/pieces/section.hpp"

namespace shapespline::pieces {

struct PiecesBudget {
    Index stride;       // of candidate nodes
    double resolution;  // their polyline passes the data within it
    Index every;        // one candidate in so many is looked from
    int passes;         // of the reduction
    bool thorough;      // two neighbours on each side of a move, too, and bold moves with one
};

struct PiecesSettings {
    double tolerance;
    int largest_degree;   // 1 to 3
    bool smooth;          // joints that are no corners are tangent
    bool ends_fixed;      // an open outline begins and ends in its first and last datum
    double least_corner;  // radians: a corner that the fit turns less is given up
    PiecesBudget budget;
};

}  // namespace shapespline::pieces
