#include "core/path/geometry/path_trail.hpp"

#include <algorithm>

#include "core/check.hpp"

namespace lockstep {
namespace {

Displacement way_of(double mm) { return {static_cast<Int128>(mm * 0x1p64)}; }
double mm_of(Displacement way) { return static_cast<double>(way.raw) * 0x1p-64; }

bool is_before(const PathSpot& a, const PathSpot& b) { return a.piece != b.piece ? a.piece < b.piece : a.u < b.u; }

}  // namespace

void PathTrail::clear() {
    pieces_.clear();
    marks_.clear();
    first_ = 0;
    is_at_rest_ = true;
}

void PathTrail::mark(double u, std::uint32_t block, double along) {
    marks_.push_back({{end(), u}, block, along == 0 ? Displacement{} : way_of(along)});
}

void PathTrail::add_rest(const Quadratic& rest, std::uint32_t block) {
    const bool is_at_end = !marks_.empty() && marks_.back().block == block;
    const Displacement along = is_at_end ? place_of({end() - 1, pieces_.back().length}).along : Displacement{};
    marks_.push_back({{end(), 0}, block, along});
    add(rest);
    is_at_rest_ = true;
}

void PathTrail::pop_back() {
    is_at_rest_ = pieces_.back().begins_at_rest;
    pieces_.pop_back();
    while (!marks_.empty() && marks_.back().at.piece == end()) { marks_.pop_back(); }
}

void PathTrail::drop_before(std::size_t piece) {
    while (first_ < std::min(piece, end())) {
        pieces_.pop_front();
        ++first_;
    }
    while (!marks_.empty() && marks_.front().at.piece < first_) { marks_.pop_front(); }
}

PathPlace PathTrail::place_of(const PathSpot& spot) const {
    const auto behind = std::upper_bound(marks_.begin(), marks_.end(), spot,
                                         [](const PathSpot& at, const Mark& mark) { return is_before(at, mark.at); });
    check(behind != marks_.begin() && spot.piece < end(), "a place is asked for where the geometry is kept");
    const Mark& mark = *(behind - 1);
    return {mark.block, mark.along + way_of(spot.u - mark.at.u)};
}

std::optional<PathSpot> PathTrail::spot_of(const PathPlace& place) const {
    const auto is_earlier = [](const Mark& mark, std::uint32_t block) { return mark.block < block; };
    auto mark = std::lower_bound(marks_.begin(), marks_.end(), place.block, is_earlier);
    if (mark == marks_.end()) { return std::nullopt; }
    if (mark->block != place.block) { return mark->at; }
    auto next = mark + 1;
    for (; next != marks_.end() && next->block == place.block && next->along <= place.along; ++next) { mark = next; }
    const bool is_same_piece = next != marks_.end() && next->at.piece == mark->at.piece;
    const double most = is_same_piece ? next->at.u : piece(mark->at.piece).length;
    return PathSpot{mark->at.piece, std::clamp(mark->at.u + mm_of(place.along - mark->along), mark->at.u, most)};
}

}  // namespace lockstep
