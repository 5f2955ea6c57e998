#include <tribodraw/base/files.h>
#include <tribodraw/output/report.h>

#include "report_parts.h"

#include <cctype>
#include <regex>
#include <sstream>

namespace tribodraw
{
  namespace
  {
    namespace fs = std::filesystem;

    constexpr const char *style = R"(
:root{color-scheme:light dark;--page:#fff;--text:#1b1f24;--soft:#59636e;--line:#d1d9e0;--card:#f6f8fa;--accent:#0b6ea8;--warn:#9a6700}
@media(prefers-color-scheme:dark){:root{--page:#12161b;--text:#e6edf3;--soft:#9aa4ae;--line:#343b44;--card:#1a2027;--accent:#58b0e6;--warn:#d4a72c}}
*{box-sizing:border-box}
body{margin:0 auto;max-width:75rem;padding:1.5rem;background:var(--page);color:var(--text);font:16px/1.5 system-ui,Helvetica,Arial,sans-serif;overflow-wrap:break-word}
h1{margin:0 0 .25rem;font-size:1.8rem}h2{margin:2.25rem 0 .75rem;font-size:1.3rem;border-bottom:1px solid var(--line);padding-bottom:.25rem}h3{margin:1.5rem 0 .5rem;font-size:1.05rem}
.sub{color:var(--soft);margin:0}nav{margin:1rem 0 0;display:flex;flex-wrap:wrap;gap:.25rem 1.25rem}
table{border-collapse:collapse;width:100%}td,th{padding:.3rem .75rem .3rem 0;border-bottom:1px solid var(--line);text-align:left;vertical-align:top}
td.number,th.number{text-align:right;font-variant-numeric:tabular-nums;white-space:nowrap}
.scroll{overflow-x:auto}
.tiles{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,15rem),1fr));gap:.75rem}
.tile{padding:.75rem 1rem;background:var(--card);border:1px solid var(--line);border-radius:.5rem;color:var(--soft);font-size:.9rem;break-inside:avoid}
.tile b{display:block;color:var(--text);font-size:1.5rem;font-weight:600}.tile span{font-size:1rem;font-weight:400}
.figures{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,22rem),1fr));gap:1rem}
figure{margin:0;padding:.75rem;background:var(--card);border:1px solid var(--line);border-radius:.5rem;break-inside:avoid}
figure svg{width:100%;height:auto;color:var(--text)}figcaption{color:var(--soft);font-size:.9rem}
.inputs{columns:22rem;column-gap:2rem}.inputs section{break-inside:avoid-column;margin:0 0 1rem}.inputs h3{margin-top:0}.inputs table{font-size:.9rem}
.inputs th{font-weight:600;padding-top:.6rem;color:var(--soft)}.inputs td{width:50%;overflow-wrap:anywhere}
pre{margin:0;padding:.75rem;background:var(--card);border:1px solid var(--line);border-radius:.5rem;overflow-x:auto;white-space:pre-wrap;font:13px/1.45 ui-monospace,monospace}
.warnings li{color:var(--warn)}
a{color:var(--accent)}
@media(max-width:30rem){body{padding:.75rem}figure{padding:.4rem}.tiles{grid-template-columns:1fr 1fr}}
@media print{nav{display:none}body{max-width:none;padding:0;font-size:10pt}figure,pre,.tile{background:none}pre{font-size:8pt}.figures{grid-template-columns:1fr 1fr}.tiles{grid-template-columns:repeat(4,1fr)}.inputs{columns:2}}
)";

    std::string
    read_if_present(const fs::path &file)
    {
      return fs::exists(file) ? read_file(file) : std::string();
    }

    std::string
    anchor(const std::string &title)
    {
      std::string id;
      for (const char c : title)
        id += std::isalnum(static_cast<unsigned char>(c))
                  ? static_cast<char>(std::tolower(static_cast<unsigned char>(c)))
                  : '-';
      return id;
    }

    std::string
    warnings(const fs::path &folder)
    {
      std::istringstream log(read_if_present(folder / "log.txt"));
      std::string        items;
      for (std::string line; std::getline(log, line);)
        if (line.rfind("Warning: ", 0) == 0)
          items += "<li>" + report::escape(line.substr(9)) + "</li>\n";
      return report::heading("Warnings")
             + (items.empty() ? "<p>None.</p>\n" : "<ul class=\"warnings\">\n" + items + "</ul>\n");
    }

    std::string
    text_section(const std::string &title, const fs::path &file)
    {
      const std::string text = read_if_present(file);
      return text.empty() ? "" : report::heading(title) + "<pre>" + report::escape(text) + "</pre>\n";
    }

    /// Links to the headings of a page.
    std::string
    contents(const std::string &body)
    {
      std::string      html;
      const std::regex heading("<h2 id=\"([^\"]*)\">([^<]*)</h2>");
      for (std::sregex_iterator it(body.begin(), body.end(), heading), end; it != end; ++it)
        html += "<a href=\"#" + (*it)[1].str() + "\">" + (*it)[2].str() + "</a>\n";
      return "<nav>\n" + html + "</nav>\n";
    }
  } // namespace

  std::string
  report::escape(const std::string &text)
  {
    std::string result;
    for (const char c : text)
      switch (c)
        {
        case '<':
          result += "&lt;";
          break;
        case '>':
          result += "&gt;";
          break;
        case '&':
          result += "&amp;";
          break;
        case '"':
          result += "&quot;";
          break;
        default:
          result += c;
        }
    return result;
  }

  std::string
  report::heading(const std::string &title)
  {
    return "<h2 id=\"" + anchor(title) + "\">" + escape(title) + "</h2>\n";
  }

  void
  write_report(const std::filesystem::path &folder)
  {
    const std::string name = report::escape(fs::weakly_canonical(folder).filename().string());
    const std::string body = report::key_figures(folder) + report::comparison(folder) + warnings(folder)
                             + report::audits(folder) + report::figures(folder) + report::more_results(folder) + report::surfaces(folder)
                             + report::inputs(folder) + text_section("Versions and provenance", folder / "run_info.txt")
                             + text_section("How to cite", folder / "citations.txt");
    write_file(
        folder / "report.html",
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>"
            + name + " – tribodraw</title>\n<style>" + style + "</style>\n</head>\n<body>\n<h1>" + name
            + "</h1>\n<p class=\"sub\">Report of a tribodraw run: friction in lubricated sheet-metal forming.</p>\n"
            + contents(body) + body + "</body>\n</html>\n");
  }
} // namespace tribodraw
