// The requests of a sender that the machine has not taken yet, and the one whose line waits for its answer.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clients/grbl/protocol/request.hpp"
#include "core/gcode/session/gcode_session.hpp"

namespace lockstep::grbl {

class OpenRequests {
public:
    /// A request that must be answered before its line is.
    struct Awaited {
        std::uint64_t number = 0;
        bool runs_line = false;
        std::string before_ok;            // sent before the ok of the line
        std::optional<SessionLine> line;  // leaves its modes behind if the request succeeds
    };

    Request& add(Request::Kind kind) { return requests_.emplace_back(Request{.kind = kind, .number = ++number_}); }
    /// The same; no line is read until its answer.
    Request& await(Request::Kind kind, std::string before_ok = {}, std::optional<SessionLine> line = {}) {
        Request& request = add(kind);
        awaited_ = {request.number, kind == Request::Kind::RunLine, std::move(before_ok), std::move(line)};
        return request;
    }
    const std::optional<Awaited>& awaited() const { return awaited_; }
    /// Ends the waiting at the answer to a request; nullopt if that was not awaited.
    std::optional<Awaited> end(std::uint64_t number) {
        if (!awaited_ || awaited_->number != number) { return std::nullopt; }
        return std::exchange(awaited_, std::nullopt);
    }
    void give_up() { awaited_.reset(); }
    std::vector<Request> take() { return std::exchange(requests_, {}); }

private:
    std::vector<Request> requests_;
    std::uint64_t number_ = 0;  // of the last request
    std::optional<Awaited> awaited_;
};

}  // namespace lockstep::grbl
