// A move of one axis by itself as add-only pieces, by the method that its configuration names.
//
// Ranade's method plans a profile (core/motion/profile.hpp) of three pieces at most. The other methods give the times
// of their steps (core/motion/step_source.hpp). The times are rounded to ticks and converted to pieces that make these
// steps (step_pieces.hpp).
#pragma once

#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "core/axis/own_moves/step_pieces.hpp"
#include "core/kinematics/motors.hpp"
#include "core/motion/limit_watch.hpp"
#include "core/motion/profile.hpp"
#include "core/motion/step_source.hpp"

namespace lockstep {

/// Distance, speed and duration of a move. The move is treated as forward in either direction.
struct OwnMoveRequest {
    std::int64_t steps = 0;      // > 0
    double speed_mm_s = 0;       // at most
    std::optional<Ticks> ticks;  // how long it lasts, exactly; nullopt: as fast as the limits allow
};

/// A method other than Ranade's cannot plan for a given duration.
struct NotInTime {
    StepMethod method;
};
/// The move would be slower than kLeastSpeed_mm_s, or last longer than kLongestMotion_s.
struct BelowLeastSpeed {
    double most_s = 0;  // the longest duration of this move
};
/// Why a move cannot be made.
using OwnMoveError = std::variant<NotInTime, BelowLeastSpeed, Infeasible, StepError>;

/// Says why the move is impossible and what would be possible, in the user's units.
std::string text_of(const OwnMoveError& error, const MotorConfig& motor, std::int64_t tick_ns,
                    const OwnMoveRequest& move);

/// The move in steps and seconds, within the axis's limits.
StepMove step_move_of(const MotorConfig& motor, const OwnMoveRequest& move);

class OwnPieces {
public:
    /// Plans the move by `method`, the axis's own or another. `begin_steps` begins the methods other than Ranade's.
    static std::expected<OwnPieces, OwnMoveError> plan(const MotorConfig& motor, std::int64_t tick_ns,
                                                       StepMethod method, const OwnMoveRequest& move,
                                                       BeginSteps begin_steps);

    /// Returns the next piece. It lasts at most twice as long as `most`, at every speed. Returns nullopt after the last
    /// piece, or if the next step would break the axis's limits.
    std::optional<Piece> next(Ticks most);
    /// Whether all pieces are made, so that the move ends on its last whole step.
    bool done() const { return !rest_ && is_made(); }
    /// The method would break the axis's limits, so the move ends early.
    bool broken() const { return !rest_ && is_breached(); }

private:
    /// A profile's pieces.
    struct Planned {
        std::vector<Piece> pieces;
        std::size_t made = 0;

        std::optional<Piece> next(Ticks /*most*/) { return done() ? std::nullopt : std::optional(pieces[made++]); }
        bool done() const { return made == pieces.size(); }
        bool broken() const { return false; }
    };
    /// A method's steps.
    struct Stepped {
        std::unique_ptr<StepSource> source;
        LimitWatch watch;
        double ticks_per_s;
        std::int64_t left;  // steps
        StepPieces pieces;
        double before_s = 0;  // time of the last step
        bool at_rest = false;
        bool breach = false;

        std::optional<Piece> next(Ticks most);
        std::optional<double> next_step_s();
        bool done() const { return at_rest; }
        bool broken() const { return breach; }
    };
    using Maker = std::variant<Planned, Stepped>;
    explicit OwnPieces(Maker maker) : maker_(std::move(maker)) {}

    static std::expected<OwnPieces, OwnMoveError> planned(const MotorConfig& motor, std::int64_t tick_ns,
                                                          const OwnMoveRequest& move);
    static std::expected<OwnPieces, OwnMoveError> stepped(const MotorConfig& motor, std::int64_t tick_ns,
                                                          StepMethod method, const OwnMoveRequest& move,
                                                          BeginSteps begin_steps);

    bool is_made() const;
    bool is_breached() const;

    Maker maker_;
    std::optional<Piece> rest_;  // of the piece returned last
};

}  // namespace lockstep
