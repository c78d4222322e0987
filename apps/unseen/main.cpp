// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <new>
#include <system_error>

#include "commands.h"
#include "flags.h"
#include "unexpected.h"
#include "unseen/core/error.h"
#include "unseen/core/version.h"

namespace unseen::cli {
namespace {

int report(int code, const std::string& text) {
  std::fputs(fmt::format("unseen: {}\n", text).c_str(), stderr);  // nobody may read it
  return code;
}

/// "unseen synth planes": the subcommand that was asked for, as one types it.
std::string command_name(const CLI::App& app) {
  std::string name = app.get_name();
  for (const CLI::App* at = &app; !at->get_subcommands().empty(); name += " " + at->get_name())
    at = at->get_subcommands().front();
  return name;
}

/// Throws InputError if something printed did not arrive, though somebody wants to read it.
void flush_output() {
  errno = 0;
  const bool failed = std::fflush(stdout) != 0 || std::ferror(stdout) != 0;
  if (failed && errno != EPIPE)
    throw InputError("standard output", "text", "no room, or nobody to read it", "a place to write to");
}

/// Prints what --help and --version ask for.
int print_help(const CLI::App& app, const CLI::Success& asked) {
  try {
    const int code = app.exit(asked);
    flush_output();
    return code;
  } catch (const InputError& e) {
    return report(kBadInput, e.what());
  }
}

/// Runs what the command line asks for and turns every outcome into an exit code.
int run(const CLI::App& app, const std::vector<Command>& commands) {
  try {
    for (const Command& command : commands)
      if (command.app->parsed()) {
        const int code = command.run();
        flush_output();
        return code;
      }
    throw UsageError("a subcommand is missing");
  } catch (const UsageError& e) {
    return report(kUsage, fmt::format("{}; see {} --help", e.what(), command_name(app)));
  } catch (const InputError& e) {
    return report(e.source == kCommandLine ? kUsage : kBadInput, e.what());
  } catch (const Cancelled&) {
    return report(kInterrupted, "interrupted; nothing was written");
  } catch (const std::bad_alloc&) {
    return report(kFault, "not enough memory");
  } catch (const std::system_error& e) {
    if (e.code() == std::errc::broken_pipe) return kSolved;  // nobody reads what was printed last
    return report(kFault, fmt::format("internal fault: {}", e.what()));
  } catch (const std::exception& e) {
    return report(kFault, fmt::format("internal fault: {}", e.what()));
  }
}

}  // namespace
}  // namespace unseen::cli

int main(int argc, char** argv) {
  using namespace unseen::cli;
  std::signal(SIGPIPE, SIG_IGN);  // what nobody reads must not end a run that writes files
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})  // else a file that is opened would take its place
    if (fcntl(standard, F_GETFD) < 0) open("/dev/null", O_RDWR);
  CLI::App app("Finds out what a scan or a video does not show.", "unseen");
  app.set_version_flag("--version", fmt::format("unseen {}", unseen::kVersion));
  app.require_subcommand(0, 1);
  app.footer(
      "Each subcommand has its own --help with an example.\n"
      "Exit codes: 0 solved, 2 usage, 3 bad input, 4 no solution, 130 interrupted, 1 internal fault.");
  CLI::App* synth = app.add_subcommand("synth", "Make a scene with exact truth");
  CLI::App* evaluate = app.add_subcommand("evaluate", "Measure a result against truth");
  synth->require_subcommand(0, 1)->footer("Example:\n  unseen synth planes -o room --seed 7");
  evaluate->require_subcommand(0, 1)->footer("Example:\n  unseen evaluate planes OUT --truth house.obj");
  CLI::App* scenelets = app.add_subcommand("scenelets", "Build or describe a database of short motions with the objects around them");
  scenelets->require_subcommand(0, 1)->footer("Example:\n  unseen scenelets build office lobby -o people.bin");
  const std::string command = shell_command({argv, argv + argc});
  const std::vector<Command> commands = {add_planes(app, command), add_cuboids(app, command),
                                         add_collision(app, command), add_interactions(app, command), add_stage(app, command), add_convert(app),
                                         add_synth_planes(*synth), add_synth_cuboids(*synth), add_synth_collision(*synth), add_synth_interactions(*synth),
                                         add_evaluate_planes(*evaluate), add_evaluate_cuboids(*evaluate), add_evaluate_collision(*evaluate),
                                         add_evaluate_interactions(*evaluate), add_scenelets_build(*scenelets), add_scenelets_info(*scenelets),
                                         add_view(app)};
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& e) {
    return print_help(app, e);
  } catch (const CLI::ExtrasError&) {
    return report(kUsage, fmt::format("{}; see {} --help", unexpected(app), command_name(app)));
  } catch (const CLI::ParseError& e) {
    return report(kUsage, fmt::format("{}; see {} --help", e.what(), command_name(app)));
  }
  return run(app, commands);
}
