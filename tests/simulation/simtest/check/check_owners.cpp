#include <algorithm>
#include <set>
#include <tuple>

#include "core/protocol/rules.hpp"
#include "tests/simulation/simtest/check/checks.hpp"
#include "tests/simulation/simtest/record/motions.hpp"

namespace lockstep::simtest {
namespace {

class OwnerCheck {
public:
    OwnerCheck(const Recording& recording, Violations& violations)
        : recording_(recording),
          motions_(motions_of(recording)),
          silence_(recording.machine.slot_ticks() * (3 * recording.machine.timing.freshness_slots + 10)),
          violations_(violations) {}

    void check() {
        for (std::size_t i = 0; i < recording_.motors.size(); ++i) {
            check_terms_rise(i);
            check_run_once(i);
            check_orders(i);
        }
        for (const Motion& motion : motions_) { check_followed(motion); }
        check_one_after_the_other();
        for (const auto& [number, epoch] : recording_.epochs) { check_begun(number, epoch); }
        const auto& claims = recording_.claims;
        for (std::size_t n = 1; n < claims.size(); ++n) { check_needed(claims[n - 1], claims[n]); }
    }

private:
    /// The term of an axis process never decreases. A restarted process does not know any term.
    void check_terms_rise(std::size_t i) {
        const Followed* before = nullptr;
        for (const Followed& now : recording_.motors[i].followed) {
            if (before != nullptr && before->process == now.process && now.term <= before->term) {
                object(i, now.at, "its term decreases");
            }
            before = &now;
        }
    }

    /// Each body and each tail runs once, with the content that was sent.
    void check_run_once(std::size_t i) {
        std::set<std::tuple<Epoch, FrameNumber, bool>> run;
        for (const Track& track : recording_.motors[i].tracks) {
            if (track.epoch == 0) { continue; }
            if (!run.insert({track.epoch, track.frame, track.tail}).second) {
                object(i, track.start, "frame " + std::to_string(track.frame) + " ran a second time");
            }
            const auto epoch = recording_.epochs.find(track.epoch);
            if (epoch == recording_.epochs.end() || !epoch->second.frames.contains(track.frame)) { continue; }
            const Share& sent = epoch->second.frames.at(track.frame).shares[i];
            const bool same =
                track.from == (track.tail ? sent.to : sent.from) && track.to == (track.tail ? sent.rest : sent.to);
            if (!same) { object(i, track.start, "frame " + std::to_string(track.frame) + " ran with other content"); }
        }
    }

    /// An axis moves on its own only if its owner ordered it.
    void check_orders(std::size_t i) {
        for (const Motion& motion : motions_) {
            if (motion.axis != i || motion.track == nullptr || motion.track->epoch != 0) { continue; }
            const bool ordered = std::ranges::any_of(recording_.motors[i].orders, [&](const GivenOrder& given) {
                using Kind = AxisCommandKind;
                const Kind kind = given.order.kind;
                const bool moves = kind == Kind::Home || kind == Kind::Approach || kind == Kind::MoveOwn ||
                                   kind == Kind::Jog || kind == Kind::Correct;
                return given.order.term == motion.writer && given.at <= motion.begin && moves;
            });
            if (!ordered) { object(i, motion.begin, "its owner did not order this move"); }
        }
    }

    /// Whether the axis gave its device up during the motion, which ends the motion. The device may continue later. Its
    /// steps are then a new motion from where the axis lost it.
    bool has_given_up(const Motion& motion, Tick by) const {
        return std::ranges::any_of(recording_.faults, [&](const VirtualFault& fault) {
            const bool meanwhile = fault.at < by && fault.at + fault.lasts >= motion.begin;
            return fault.is_of_device() && fault.process == motion.axis && meanwhile;
        });
    }

    /// During a motion the axis follows the owner that moves it. A restarted process may not follow an owner yet.
    void check_followed(const Motion& motion) {
        const MotorRecord& axis = recording_.motors[motion.axis];
        const bool known = motion.track != nullptr;
        if (known && axis.followed_at(motion.begin).term != motion.writer) {
            object(motion.axis, motion.begin, "it moves for an owner that it does not follow");
        }
        for (const Followed& f : axis.followed) {
            const bool meanwhile = f.at > motion.begin && f.at < motion.end && !has_given_up(motion, f.at);
            if (meanwhile && f.term != motion.writer && f.term != Term{}) {
                object(motion.axis, f.at,
                       "it follows another owner while it moves, from tick " + std::to_string(motion.begin.value) +
                           " to " + std::to_string(motion.end.value));
            }
        }
    }

    /// An owner moves axes only after all motions of the previous owner. A previous owner never moves them again.
    void check_one_after_the_other() {
        const Motion* last = nullptr;  // the motion that ends last until now
        for (const Motion& motion : motions_) {
            if (last != nullptr && motion.writer != last->writer) {
                if (motion.begin < last->end) { object(motion.axis, motion.begin, "two owners move the machine"); }
                if (motion.writer < last->writer) { object(motion.axis, motion.begin, "an owner's term has returned"); }
            }
            if (last == nullptr || motion.writer != last->writer || motion.end > last->end) { last = &motion; }
        }
    }

    /// An owner sends frames only after every axis has reported that it follows this owner. The axis can have changed
    /// its owner during the message delay, and its process can have restarted.
    void check_begun(Epoch number, const SentEpoch& epoch) {
        for (std::size_t i = 0; i < recording_.motors.size(); ++i) {
            const MotorRecord& axis = recording_.motors[i];
            const Followed now = axis.followed_at(epoch.first_sent);
            const bool restarted = std::ranges::any_of(axis.followed, [&](const Followed& f) {
                return f.at <= epoch.first_sent && f.term == epoch.writer && f.process != now.process;
            });
            const Ticks way = recording_.machine.slot_ticks() * rules::kHopSlots;
            if (now.term == epoch.writer || restarted ||
                axis.followed_at(epoch.first_sent - way).term == epoch.writer) {
                continue;
            }
            object(i, epoch.first_sent,
                   "epoch " + std::to_string(number) + " began while the axis follows another owner");
        }
    }

    /// A coordinator claims a machine only when it no longer receives its owner: since the last claim, or just before,
    /// a coordinator or one of its links failed. At startup every coordinator may claim.
    void check_needed(const Claim& before, const Claim& claim) {
        if (recording_.jobs.empty() || claim.at < recording_.jobs.front().began) { return; }
        const auto is_coordinator = [&](std::size_t process) { return process >= recording_.motors.size(); };
        const bool failed = std::ranges::any_of(recording_.faults, [&](const VirtualFault& fault) {
            const bool concerns = is_coordinator(fault.process) || (fault.peer && is_coordinator(*fault.peer));
            return concerns && fault.at <= claim.at && fault.end() + silence_ * 3 >= before.at;
        });
        if (!failed) { object({}, claim.at, "a coordinator claims a machine whose owner is healthy"); }
    }

    void object(std::optional<std::size_t> axis, Tick tick, std::string what) {
        violations_.push_back({"owners", axis, tick.value, {}, std::move(what)});
    }

    const Recording& recording_;
    std::vector<Motion> motions_;
    Ticks silence_;
    Violations& violations_;
};

}  // namespace

Violations check_owners(const Recording& recording) {
    Violations violations;
    OwnerCheck(recording, violations).check();
    return violations;
}

}  // namespace lockstep::simtest
