#include "core/path/speed_window.hpp"

#include <algorithm>

#include "core/path/geometry/motor_rows.hpp"
#include "core/path/interval_cut.hpp"

namespace lockstep {
namespace {

constexpr double kLeastBegin_mm = 1e-9;  // a shorter rest of the first piece is omitted

/// Whether the path begins at the end of the piece. If the machine must rest there, the shortest remainder counts.
bool is_passed(const Quadratic& piece, const Neighbours& beside) {
    if (beside.before != nullptr || piece.length == 0) { return false; }
    const bool goes_on = beside.next != nullptr && beside.next->length > 0;
    return piece.length - beside.from <= (goes_on ? kLeastBegin_mm : 0);
}

}  // namespace

void SpeedWindow::restart(const Overrides& overrides, const PathSpot& begin, std::span<const Position> motors) {
    clear(begin.piece);
    overrides_ = overrides;
    begin_u_ = begin.u;
    backlash_.restart(begin.u, motors);
    joint_.reset();
}

void SpeedWindow::add(const Quadratic& piece) {
    if (!setup_.has_map()) { return add_rows(piece); }
    if (!setup_.backlashes.empty()) {
        for (const Quadratic& rows : backlash_.rows_of(setup_, piece)) { add_rows(rows); }
        return;
    }
    for (RowPieces rows(setup_, piece); !rows.is_done();) { add_rows(rows.next()); }
}

void SpeedWindow::add_rows(const Quadratic& piece) {
    pieces_.make_back([&] {
        JoinedPiece made;
        made.shape = piece;
        made.shape.moving = moving_rows(piece);
        return made;
    });
    if (is_open_) { close_piece(pieces_.size() - 2); }
    is_open_ = true;
    if (is_due()) { look_ahead(); }
}

void SpeedWindow::finish() {
    close_end();
    look_ahead();
    final_ = end();
}

void SpeedWindow::close_end() {
    if (is_open_) {
        end_cap_ = joint_at_end(pieces_.size() - 1).cap;
        close_piece(pieces_.size() - 1);
    }
    is_open_ = false;
    is_finished_ = true;
}

/// The pieces beside a piece of the window.
Neighbours SpeedWindow::beside(std::size_t k) const {
    if (k > 0) { return {.before = shape_at(k - 1), .next = shape_at(k + 1)}; }
    return {.next = shape_at(1), .from = begin_of(pieces_[0].shape)};
}

Joint SpeedWindow::joint_at_end(std::size_t k) const { return joints().joint(shape_at(k), shape_at(k + 1), 0); }

/// Closes a piece when the next one is known, or there is none.
void SpeedWindow::close_piece(std::size_t k) {
    JoinedPiece& piece = pieces_[k];
    Neighbours beside = this->beside(k);
    if (is_passed(piece.shape, beside)) {
        if (beside.next == nullptr || beside.next->piece != piece.shape.piece) { begin_u_ = 0; }
        ++first_piece_;
        return pieces_.pop_front();
    }
    beside.begin = joint_ ? *joint_ : joints().joint(beside.before, &piece.shape, beside.from);
    beside.end = joint_at_end(k);
    joint_ = beside.end;
    piece.rows = piece.shape.moving | beside.moving();
    joints().settle(piece, beside);
    beside.begin.cap = std::min(beside.begin.cap, piece.begin_cap);
    if (k > 0) { beside.begin.cap = std::min(beside.begin.cap, pieces_[k - 1].end_cap); }
    IntervalCut(setup_, overrides_).cut(piece, first_piece_ + k, beside, intervals_);
}

}  // namespace lockstep
