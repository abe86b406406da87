// The whole server: the machine's thread, the thread for programs, and the thread of HTTP.
#pragma once

#include <expected>
#include <memory>
#include <mutex>
#include <string>

#include "clients/web/api/api.hpp"
#include "clients/web/http/server.hpp"
#include "clients/web/machine/machine_loop.hpp"

namespace lockstep::web {

struct SiteOptions {
    Listener listener;
    TlsFiles tls;
    AccessRules rules;
    std::filesystem::path reports;
    std::string version;
    std::string writer;  // this server's name as a writer
};

class Site {
public:
    /// Serves until the object is destroyed. The error says why it cannot serve.
    static std::expected<std::unique_ptr<Site>, std::string> open(Session session, const SiteOptions& options);
    ~Site();
    Site(const Site&) = delete;
    Site& operator=(const Site&) = delete;

private:
    Site(Session session, const SiteOptions& options);
    void publish(const Snapshot& snapshot);

    MachineSetup machine_;
    EventLog log_;
    ProgramDesk desk_;
    ReportFiles reports_;
    MachineLoop loop_;
    Api api_;
    std::mutex mutex_;  // protects server_, which the machine's thread uses
    std::unique_ptr<Server> server_;
};

}  // namespace lockstep::web
