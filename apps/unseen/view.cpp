// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the unseen authors
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <filesystem>
#include <memory>

#include "commands.h"
#include "session.h"
#include "shown.h"
#include "unseen/core/error.h"
#include "unseen/io/output_folder.h"
#include "unseen/report/page.h"
#include "unseen/report/stored_run.h"
#include "write_text.h"

extern char** environ;

namespace unseen::cli {
namespace {

struct ViewArguments {
  std::string first, second, page;
  CommonFlags common;
  bool open = false;
};

/// Shows a file in what the desktop opens pages with.
void open_in_browser(const std::string& page) {
  std::string opener = "xdg-open", file = page;
  char* const words[] = {opener.data(), file.data(), nullptr};
  pid_t child = 0;
  int status = 1;
  if (posix_spawnp(&child, opener.c_str(), nullptr, nullptr, words, environ) != 0 || waitpid(child, &status, 0) < 0 || status != 0)
    throw InputError(page, "--open", "no program that opens it", "xdg-open; the page itself is written");
}

/// A page replaces nothing but a page: no file of a result, nor what a result was made from.
void check_page(const std::filesystem::path& page) {
  std::error_code error;
  const std::filesystem::path target = std::filesystem::weakly_canonical(page, error);  // what a link leads to
  const std::string ending = target.extension().string();
  if (std::filesystem::is_regular_file(target, error) && ending != ".html" && ending != ".htm")
    throw InputError(kCommandLine, "-o", fmt::format("{}, a file that is no page", page.string()), "a name that ends in .html, or of no file");
}

int run(ViewArguments& args) {
  OptionTable table;
  if (resolve_or_dump(table, args.common, "view", {})) return kSolved;
  require(args.first, "OUT");
  if (!args.page.empty()) check_page(args.page);
  Session session(args.common);
  Summary summary;
  std::vector<std::string> scenes;
  std::string title;
  {
    const Stage stage(session.context, summary, "view");
    for (const std::string& out : {args.first, args.second}) {
      if (out.empty()) continue;
      Shown shown = read_shown(out, session.context);
      title += (title.empty() ? "" : " | ") + shown.title;
      scenes.push_back(std::move(shown.scene));
    }
  }
  session.progress.warn(session.context.take_warnings());
  const std::filesystem::path standard = std::filesystem::path(args.first) / (scenes.size() == 1 ? "report.html" : "compare.html");
  const std::string page = args.page.empty() ? standard.string() : args.page;
  io::AtomicFile file(page);
  write_text(file.path(), report::page_of(title, scenes));
  file.commit();
  if (args.common.json) {
    fmt::print("{}", report::summary_json(summary));
  } else if (!args.common.quiet) {
    fmt::print("page: {}\n", page);
  }
  if (args.open) open_in_browser(page);
  return kSolved;
}

}  // namespace

Command add_view(CLI::App& app) {
  auto args = std::make_shared<ViewArguments>();
  CLI::App* sub = app.add_subcommand("view", "Write the page of a result again, or one that shows two side by side");
  sub->add_option("OUT", args->first, "the folder of a result");
  sub->add_option("OTHER", args->second, "the folder of another one, to be shown beside it");
  sub->add_option("-o", args->page, "the page to write (default OUT/report.html, for two results OUT/compare.html); of files that are there, only .html is replaced")->type_name("PAGE");
  sub->add_flag("--open", args->open, "open it in the browser");
  add_flags(*sub, args->common);
  sub->footer("Examples:\n  unseen view out --open\n  unseen view out_5cm out_10cm -o compare.html");
  return {sub, [args] { return run(*args); }};
}

}  // namespace unseen::cli
