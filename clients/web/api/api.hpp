// The server's interface, as openapi.yaml describes it: routes, access, and what each request does.
#pragma once

#include <atomic>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "clients/web/api/access.hpp"
#include "clients/web/api/assets.hpp"
#include "clients/web/api/machine_orders.hpp"
#include "clients/web/api/replay_guard.hpp"
#include "clients/web/api/report_files.hpp"
#include "clients/web/http/message.hpp"
#include "clients/web/machine/port.hpp"
#include "clients/web/program/mdi_session.hpp"
#include "clients/web/program/program_desk.hpp"
#include "clients/web/state/event_log.hpp"

namespace lockstep::web {

/// The parts that an Api uses; all must outlive it.
struct ApiParts {
    const MachineSetup& machine;
    MachinePort& port;
    EventLog& log;
    ProgramDesk& desk;
    const ReportFiles& reports;
    std::span<const Asset> assets;
    std::string version;
};

class Api : public Handler {
public:
    Api(const ApiParts& parts, AccessRules rules);

    Intake intake(const Request& head) const override;
    void handle(Request&& request, const Answer& answer) override;

    /// Takes the machine's state, and adds it to the event log if there are viewers. May be called from any thread.
    void publish(const Snapshot& snapshot);
    std::size_t viewers() const { return viewers_; }

private:
    using Route = void (Api::*)(Request&& request, const Answer& answer);
    struct Row {
        std::string_view method;
        std::string_view path;  // with * for the last part
        bool is_open = false;   // needs no session
        Route route;
    };
    static const std::vector<Row>& rows();
    void serve(Request&& request, const Answer& answer);

    void open_session(Request&& request, const Answer& answer);
    void show_session(Request&& request, const Answer& answer);
    void close_session(Request&& request, const Answer& answer);
    void show_machine(Request&& request, const Answer& answer);
    void show_state(Request&& request, const Answer& answer);
    void open_events(Request&& request, const Answer& answer);
    void take_command(Request&& request, const Answer& answer);
    void load(Request&& request, const Answer& answer);
    void show_program(Request&& request, const Answer& answer);
    void show_path(Request&& request, const Answer& answer);
    void show_mdi(Request&& request, const Answer& answer);
    void show_heights(Request&& request, const Answer& answer);
    void list_reports(Request&& request, const Answer& answer);
    void show_report(Request&& request, const Answer& answer);

    nlohmann::json state_of(const Snapshot& snapshot) const;
    void note_begin(const std::string& stream);
    void note_end(const std::string& stream);
    bool is_open(const std::string& stream);

    ApiParts parts_;
    Access access_;
    ReplayGuard replays_;
    std::string stream_names_;  // each begins with this
    std::uint64_t last_stream_ = 0;
    std::mutex streams_mutex_;
    std::set<std::string> streams_;         // the names of those that are open
    std::atomic<std::size_t> viewers_ = 0;  // the number of streams_
    MdiSession mdi_;
    MachineOrders orders_;
};

}  // namespace lockstep::web
