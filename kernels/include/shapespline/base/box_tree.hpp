// Nearest-neighbour search over items that come in order along a curve.
//
// Neighbours in the sequence are neighbours in the plane, so a binary tree over the sequence itself
// has tight boxes and needs no sorting. O(n) to build; exact.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "shapespline/base/vec2.hpp"

namespace shapespline {

struct Box {
    Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    Vec2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

    void include(Vec2 p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    void include(const Box &b) {
        low = {std::min(low.x, b.low.x), std::min(low.y, b.low.y)};
        high = {std::max(high.x, b.high.x), std::max(high.y, b.high.y)};
    }
    bool meets(const Box &b) const {
        return low.x <= b.high.x && b.low.x <= high.x && low.y <= b.high.y && b.low.y <= high.y;
    }
    double distance_sq(Vec2 p) const {
        const double dx = std::max({low.x - p.x, 0.0, p.x - high.x});
        const double dy = std::max({low.y - p.y, 0.0, p.y - high.y});
        return dx * dx + dy * dy;
    }
    double distance_sq(const Box &b) const {
        const double dx = std::max({low.x - b.high.x, 0.0, b.low.x - high.x});
        const double dy = std::max({low.y - b.high.y, 0.0, b.low.y - high.y});
        return dx * dx + dy * dy;
    }
};

class BoxTree {
  public:
    // `include_item(i, box)` widens a box by item i.
    template <class IncludeItem>
    BoxTree(std::size_t n_items, IncludeItem &&include_item)
        : n_items_(n_items),
          n_leaves_(std::bit_ceil((n_items_ + kLeafSize - 1) / kLeafSize)),
          boxes_(2 * n_leaves_) {
        for (std::size_t i = 0; i < n_items_; ++i)
            include_item(i, boxes_[n_leaves_ + i / kLeafSize]);
        for (std::size_t node = n_leaves_ - 1; node > 0; --node) {
            boxes_[node].include(boxes_[2 * node]);
            boxes_[node].include(boxes_[2 * node + 1]);
        }
    }

    // Calls visit(item) for items that may lie nearer to p than best_sq, which visit lowers. An
    // item worth trying first (the last answer) makes the search short.
    template <class Visit>
    void search(Vec2 p, const double &best_sq, std::size_t hint, Visit &&visit) const {
        visit_leaf(std::min(hint, n_items_ - 1) / kLeafSize, visit);
        std::array<std::size_t, 2 * 64> stack;
        std::size_t depth = 0;
        stack[depth++] = 1;
        while (depth > 0) {
            const std::size_t node = stack[--depth];
            if (boxes_[node].distance_sq(p) >= best_sq) continue;
            if (node >= n_leaves_) {
                visit_leaf(node - n_leaves_, visit);
                continue;
            }
            const bool left_first =
                boxes_[2 * node].distance_sq(p) <= boxes_[2 * node + 1].distance_sq(p);
            stack[depth++] = 2 * node + (left_first ? 1 : 0);
            stack[depth++] = 2 * node + (left_first ? 0 : 1);
        }
    }

    // Calls visit(item) for all items that may lie nearer to a box than a distance.
    template <class Visit>
    void visit_near(const Box &box, double distance_sq, Visit &&visit) const {
        std::array<std::size_t, 2 * 64> stack;
        std::size_t depth = 0;
        stack[depth++] = 1;
        while (depth > 0) {
            const std::size_t node = stack[--depth];
            if (boxes_[node].distance_sq(box) >= distance_sq) continue;
            if (node >= n_leaves_) {
                visit_leaf(node - n_leaves_, visit);
                continue;
            }
            stack[depth++] = 2 * node + 1;
            stack[depth++] = 2 * node;
        }
    }

    // Calls visit(i, k), i < k, for all pairs of items whose boxes may meet; none of those from an
    // item to another that `apart(first, last)` leaves out.
    template <class Visit, class Apart>
    void visit_pairs(Visit &&visit, Apart &&apart) const {
        std::vector<std::pair<std::size_t, std::size_t>> stack{{1, 1}};
        while (!stack.empty()) {
            const auto [a, b] = stack.back();  // of one level
            stack.pop_back();
            if (!boxes_[a].meets(boxes_[b]) || apart(first_item(a), last_item(b))) continue;
            if (a >= n_leaves_) {
                const auto from = [&](std::size_t i) {
                    visit_leaf(b - n_leaves_, [&](std::size_t k) { if (i < k) visit(i, k); });
                };
                visit_leaf(a - n_leaves_, from);
                continue;
            }
            stack.emplace_back(2 * a, 2 * b);
            stack.emplace_back(2 * a, 2 * b + 1);
            stack.emplace_back(2 * a + 1, 2 * b + 1);
            if (a != b) stack.emplace_back(2 * a + 1, 2 * b);
        }
    }
    template <class Visit>
    void visit_pairs(Visit &&visit) const {
        visit_pairs(visit, [](std::size_t, std::size_t) { return false; });
    }

  private:
    static constexpr std::size_t kLeafSize = 4;

    // Of a node whose box is not empty.
    std::size_t first_item(std::size_t node) const {
        const int level = std::countl_zero(node) - std::countl_zero(n_leaves_);
        return ((node << level) - n_leaves_) * kLeafSize;
    }
    std::size_t last_item(std::size_t node) const {
        const int level = std::countl_zero(node) - std::countl_zero(n_leaves_);
        return std::min((((node + 1) << level) - n_leaves_) * kLeafSize, n_items_) - 1;
    }

    template <class Visit>
    void visit_leaf(std::size_t leaf, Visit &&visit) const {
        const std::size_t begin = leaf * kLeafSize;
        for (std::size_t i = begin; i < std::min(begin + kLeafSize, n_items_); ++i) visit(i);
    }

    std::size_t n_items_, n_leaves_;
    std::vector<Box> boxes_;
};

}  // namespace shapespline
