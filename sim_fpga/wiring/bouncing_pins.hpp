// Contacts that bounce: for a while after it changes, a pin shows its new and its old level in turn.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "core/hardware/output_change.hpp"
#include "core/units.hpp"

namespace lockstep {

class BouncingPins {
public:
    /// The contact at pin `pin` bounces for so long. The times between its bounces are drawn, the same in each run.
    void bounce(unsigned pin, Ticks lasts) {
        contacts_[pin].lasts = lasts;
        bouncing_ |= lasts > Ticks{} ? std::uint32_t{1} << pin : 0;
    }

    /// `levels`: of the contacts after tick `now`; pin n is bit n. Returns what the pins show. No contact bounces at
    /// the first call.
    std::uint32_t look(std::uint32_t levels, Tick now) {
        for (std::uint32_t n = 0; bouncing_ >> n != 0; ++n) {
            const std::uint32_t bit = std::uint32_t{1} << n;
            if ((bouncing_ & bit) == 0) { continue; }
            const bool shown = contacts_[n].look((levels & bit) != 0, now);
            levels = shown ? levels | bit : levels & ~bit;
        }
        return levels;
    }

    /// The next tick at which a pin may show another level while no contact changes; nullopt: none will.
    std::optional<Tick> next() const {
        std::optional<Tick> first;
        if (bouncing_ == 0) { return first; }
        for (const Contact& contact : contacts_) {
            if (contact.turns) { first = std::min(first.value_or(*contact.turns), *contact.turns); }
        }
        return first;
    }

private:
    struct Contact {
        Ticks lasts;
        std::optional<bool> level;  // none: it was never seen
        bool shown = false;
        Tick until;
        std::optional<Tick> turns;  // when the pin shows the other level; none: it is steady
        std::uint32_t drawn = 1;

        bool look(bool now_level, Tick now) {
            if (level != now_level) {
                const bool begins = level.has_value();
                level = shown = now_level;
                until = now + lasts;
                turns = begins ? std::optional(now + gap()) : std::nullopt;
            }
            while (turns && *turns <= now) { turn(); }
            return shown;
        }
        void turn() {
            const Tick at = *turns;
            shown = at < until ? !shown : *level;
            turns = at < until ? std::optional(std::min(at + gap(), until)) : std::nullopt;
        }
        /// About an eighth of the time, by a linear congruential generator (Numerical Recipes).
        Ticks gap() {
            drawn = drawn * 1'664'525 + 1'013'904'223;
            return Ticks{1 + static_cast<std::int64_t>(drawn >> 8) % std::max<std::int64_t>(1, lasts.value / 4)};
        }
    };

    std::array<Contact, kMostInputs> contacts_{};
    std::uint32_t bouncing_ = 0;
};

}  // namespace lockstep
