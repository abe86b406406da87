// lockstep-web: the command line.
#include <csignal>
#include <iostream>
#include <thread>

#include <CLI/CLI.hpp>

#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/output.hpp"
#include "clients/web/site.hpp"
#include "clients/web/token_file.hpp"
#include "services/files/directories.hpp"
#include "services/files/text_file.hpp"
#include "services/network/host_name.hpp"
#include "services/runtime/stop_signal.hpp"

namespace {

using namespace lockstep;
using namespace std::chrono_literals;

struct Options {
    std::string machine_file;
    std::string address = "127.0.0.1";
    std::uint16_t port = 2302;
    std::string certificate;
    std::string key;
    std::vector<std::string> host_names;
    std::string token_file;
    std::string reports;
};

std::expected<web::TlsFiles, Failure> read_tls(const Options& options) {
    web::TlsFiles tls;
    for (const auto& [file, text] : {std::pair{&options.certificate, &tls.certificate}, {&options.key, &tls.key}}) {
        if (file->empty()) { continue; }
        auto read = read_text_file(*file);
        if (!read) { return std::unexpected(bad_file(*file, {read.error()})); }
        *text = *std::move(read);
    }
    return tls;
}

std::string address_text(const Options& options, const web::Listener& listener) {
    const bool is_six = options.address.contains(':');
    return (options.certificate.empty() ? "http://" : "https://") +
           (is_six ? "[" + options.address + "]" : options.address) + ":" + std::to_string(listener.port) + "/";
}

web::AccessRules rules_of(const Options& options, const web::Listener& listener, const web::Tokens& tokens) {
    web::AccessRules rules{.tokens = tokens,
                           .hosts = {"localhost", "127.0.0.1", "::1", options.address},
                           .port = listener.port,
                           .is_tls = !options.certificate.empty()};
    if (!listener.is_loopback) { rules.hosts.push_back(host_name()); }
    rules.hosts.insert(rules.hosts.end(), options.host_names.begin(), options.host_names.end());
    return rules;
}

void print(const Options& options, const web::Listener& listener, const web::Tokens& tokens,
           const std::filesystem::path& file, const std::string& machine, Output& output) {
    const std::string address = address_text(options, listener);
    output.print("machine '" + machine + "': the page to operate it, and the one to view it; the tokens are also in " +
                 file.string() + "\n" + address + "#token=" + tokens.operate + "\n" + address +
                 "#token=" + tokens.view);
    std::cout << std::flush;
}

int run(const Options& options) {
    Output output(false);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    const auto tls = read_tls(options);
    if (!tls) { return output.fail(tls.error()); }
    const auto listener = web::listen_at(options.address, options.port);
    if (!listener) { return output.fail(failed(listener.error())); }
    if (!listener->is_loopback && !tls->is_used()) {
        return output.fail(bad_input("--address " + options.address +
                                     ": beyond this host the page is served with TLS only: add --certificate FILE and "
                                     "--key FILE, or listen at 127.0.0.1 and use an SSH tunnel"));
    }
    const std::filesystem::path root = record_directory(machine->config.name).parent_path();
    const std::filesystem::path file =
        options.token_file.empty() ? root / "web" / "tokens" : std::filesystem::path(options.token_file);
    const auto tokens = web::tokens_of_file(file);
    if (!tokens) { return output.fail(failed(tokens.error())); }
    auto session = Session::join(*machine, Purpose::Command);
    if (!session) { return output.fail(session.error()); }
    const StopSignal stop;
    const auto site =
        web::Site::open(*std::move(session),
                        {.listener = *listener,
                         .tls = *tls,
                         .rules = rules_of(options, *listener, *tokens),
                         .reports = options.reports.empty() ? root / "reports" : std::filesystem::path(options.reports),
                         .version = LOCKSTEP_VERSION,
                         .writer = "the page at " + address_text(options, *listener)});
    if (!site) { return output.fail(failed(site.error())); }
    print(options, *listener, *tokens, file, machine->config.name, output);
    while (!stop.requested()) { std::this_thread::sleep_for(50ms); }
    return kExitDone;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Serves a page for a machine, and its interface of HTTP, until SIGTERM or SIGINT. One process beside the "
        "machine: nothing in motion depends on it."};
    Options options;
    app.add_option("--machine", options.machine_file,
                   "the machine's configuration file; else $LOCKSTEP_MACHINE, else the machine that is up on this "
                   "host, else /etc/lockstep/machine.textproto");
    app.add_option("--address", options.address, "where to listen; beyond this host only with a certificate")
        ->capture_default_str();
    app.add_option("--port", options.port, "the TCP port; 0: a free one")->capture_default_str();
    CLI::Option* certificate = app.add_option("--certificate", options.certificate, "serve HTTPS: the PEM file");
    CLI::Option* key = app.add_option("--key", options.key, "the certificate's key, a PEM file");
    certificate->needs(key);
    key->needs(certificate);
    app.add_option("--host-name", options.host_names,
                   "another name under which the page may be opened, besides localhost and the address");
    app.add_option("--token-file", options.token_file,
                   "where the tokens are, and are made if they are missing; default: beside the machine's record");
    app.add_option("--reports", options.reports,
                   "the directory of report pages to show; default: beside the machine's record");
    app.footer(
        "Examples:\n  lockstep-web\n  lockstep-web --machine mill.textproto --port 8080\n"
        "  lockstep-web --address 0.0.0.0 --certificate mill.crt --key mill.key --host-name mill.example\n"
        "Exit codes: 0 ended as asked, 1 failed, 2 wrong usage or configuration, 3 machine not reachable");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) { return app.exit(error) == 0 ? kExitDone : kExitBadInput; }
    return run(options);
}
