#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/friction_table/friction_table.h>

#include <array>
#include <utility>

namespace tribodraw
{
  namespace
  {
    using nlohmann::json;

    constexpr const char *format_name    = "tribodraw friction table";
    constexpr int         format_version = 1;

    struct AxisName
    {
      const char *name, *unit;
    };

    constexpr AxisName pressure{ "solid pressure", "MPa" }, strain{ "equivalent plastic strain", "1" },
        cut_height{ "cut height", "mm" }, layer_pressure{ "pressure in the boundary layer", "MPa" };

    /// Every table of the file: key, axes, unit and meaning. One list serves writing and reading.
    template <class Content, class Visitor>
    void
    visit_tables(Content &t, const Visitor &visit)
    {
      visit("cut_height_normal", t.cut_height_normal, std::array<AxisName, 2>{ pressure, strain }, "mm",
            "cut height under load alone");
      visit("strain_load_per_descent", t.strain_load_per_descent,
            std::array<AxisName, 3>{ pressure, strain, cut_height }, "MPa/mm",
            "solid pressure times plastic strain per descent of the cut height; negative: load alone flattens");
      visit("cut_height_monotone", t.cut_height_monotone, std::array<AxisName, 2>{ pressure, strain }, "mm",
            "cut height after loading the undeformed sheet and straining it at constant solid pressure");
      visit("boundary_layer_shear", t.boundary_layer_shear, std::array<AxisName, 1>{ layer_pressure }, "MPa",
            "shear stress of the boundary layer per real area, before the cap by the shear strength");
      visit("shear_strength", t.shear_strength, std::array<AxisName, 1>{ strain }, "MPa",
            "shear strength of the sheet, flow stress / sqrt(3)");
      visit("ploughing_coefficient", t.ploughing_coefficient, std::array<AxisName, 2>{ pressure, strain }, "1",
            "ploughing shear per nominal area and solid pressure");
    }

    template <class Curves, class Visitor>
    void
    visit_curves(Curves &c, const Visitor &visit)
    {
      visit("cut_height", c.cut_height, "mm");
      visit("contact_fraction", c.contact_fraction, "1");
      visit("h_avg", c.h_avg, "mm");
      visit("phi_p_xx", c.phi_p_xx, "1");
      visit("phi_p_xy", c.phi_p_xy, "1");
      visit("phi_p_yx", c.phi_p_yx, "1");
      visit("phi_p_yy", c.phi_p_yy, "1");
      visit("phi_s_xx", c.phi_s_xx, "1");
      visit("phi_s_xy", c.phi_s_xy, "1");
      visit("phi_s_yx", c.phi_s_yx, "1");
      visit("phi_s_yy", c.phi_s_yy, "1");
    }

    /// Reads members of a JSON object with messages that name file and place.
    class Reader
    {
    public:
      explicit Reader(std::string file_name) : file(std::move(file_name)) {}

      [[noreturn]] void
      fail(const std::string &what, const std::string &place, const std::string &allowed = "") const
      {
        throw InputError(describe_error(what, file + (place.empty() ? "" : ", `" + place + "`"), "", allowed,
                                        "Build the table again, or name another file."));
      }

      const json &
      member(const json &object, const std::string &key, const std::string &place) const
      {
        if (!object.is_object() || !object.contains(key))
          fail("The friction table lacks an entry", place.empty() ? key : place + "/" + key);
        return object.at(key);
      }

      double
      number(const json &object, const std::string &key, const std::string &place) const
      {
        const json &j = member(object, key, place);
        if (!j.is_number())
          fail("An entry of the friction table is not a number", place.empty() ? key : place + "/" + key);
        return j.get<double>();
      }

      std::string
      text(const json &object, const std::string &key, const std::string &place) const
      {
        const json &j = member(object, key, place);
        if (!j.is_string())
          fail("An entry of the friction table is not a text", place.empty() ? key : place + "/" + key);
        return j.get<std::string>();
      }

      std::vector<double>
      numbers(const json &object, const std::string &key, const std::string &place) const
      {
        const json &j = member(object, key, place);
        if (!j.is_array())
          fail("An entry of the friction table is not a list of numbers", place + "/" + key);
        std::vector<double> result;
        result.reserve(j.size());
        for (const json &x : j)
          {
            if (!x.is_number())
              fail("A list of the friction table has an item that is not a number", place + "/" + key);
            result.push_back(x.get<double>());
          }
        return result;
      }

      void
      unit(const json &object, const std::string &expected, const std::string &place) const
      {
        if (const std::string found = text(object, "unit", place); found != expected)
          fail("An entry of the friction table has the unit `" + found + "`", place, "`" + expected + "`");
      }

      const std::string &
      name() const
      {
        return file;
      }

    private:
      std::string file;
    };

    template <int N, std::size_t M>
    json
    table_to_json(const Table<N> &t, const std::array<AxisName, M> &names, const char *unit, const char *meaning)
    {
      json axes = json::array();
      for (int d = 0; d < N; ++d)
        axes.push_back({ { "name", names[d].name },
                         { "unit", names[d].unit },
                         { "scale", t.axes()[d].scale == AxisScale::linear ? "linear" : "logarithmic" },
                         { "points", t.axes()[d].points } });
      return { { "meaning", meaning }, { "unit", unit }, { "axes", axes }, { "values", t.values() } };
    }

    template <std::size_t M>
    Table<static_cast<int>(M)>
    table_from_json(const json &j, const std::array<AxisName, M> &names, const std::string &place, const Reader &read)
    {
      const json &list = read.member(j, "axes", place);
      if (!list.is_array() || list.size() != M)
        read.fail("A table of the friction table has the wrong number of axes", place, std::to_string(M));
      constexpr int       N = static_cast<int>(M);
      std::array<Axis, N> axes;
      std::size_t         n = 1;
      for (int d = 0; d < N; ++d)
        {
          const std::string axis_place = place + "/axes/" + std::to_string(d + 1);
          const std::string scale      = read.text(list[d], "scale", axis_place);
          if (scale != "linear" && scale != "logarithmic")
            read.fail("An axis has the unknown scale `" + scale + "`", axis_place, "`linear` or `logarithmic`");
          if (const std::string name = read.text(list[d], "name", axis_place); name != names[d].name)
            read.fail("An axis is called `" + name + "`", axis_place, std::string("`") + names[d].name + "`");
          read.unit(list[d], names[d].unit, axis_place);
          axes[d].points = read.numbers(list[d], "points", axis_place);
          axes[d].scale  = scale == "linear" ? AxisScale::linear : AxisScale::logarithmic;
          axes[d].check(read.name() + ", `" + axis_place + "`");
          n *= axes[d].points.size();
        }
      std::vector<double> values = read.numbers(j, "values", place);
      if (values.size() != n)
        read.fail("A table of the friction table has " + std::to_string(values.size()) + " values", place,
                  std::to_string(n) + " by its axes");
      return Table<N>(std::move(axes), std::move(values));
    }
  } // namespace

  json
  FrictionTable::to_json() const
  {
    json j;
    j["format"]  = format_name;
    j["version"] = format_version;
    j["units"]   = { { "length", "mm" }, { "stress", "MPa" } };
    j["sq"]      = { { "meaning", "combined root mean square height of the undeformed surfaces, reference of phi_s" },
                     { "unit", "mm" },
                     { "value", sq } };
    j["initial_cut_height"]
        = { { "meaning", "top of the undeformed map" }, { "unit", "mm" }, { "value", initial_cut_height } };
    j["validity"] = { { "max_solid_pressure_mpa", max_pressure() },
                      { "max_equivalent_plastic_strain", max_strain() },
                      { "max_contact_fraction", max_contact_fraction() } };
    visit_curves(curves, [&](const char *key, const std::vector<double> &values, const char *unit) {
      j["state_curves"][key] = { { "unit", unit }, { "values", values } };
    });
    visit_tables(*this, [&](const char *key, const auto &table, const auto &names, const char *unit,
                            const char *meaning) { j["tables"][key] = table_to_json(table, names, unit, meaning); });
    j["provenance"] = provenance;
    return j;
  }

  FrictionTable
  FrictionTable::from_json(const json &j, const std::string &name)
  {
    const Reader read(name);
    if (!j.is_object() || !j.contains("format") || j.at("format") != format_name)
      read.fail("The file is not a friction table", "format", std::string("`") + format_name + "`");
    if (const double version = read.number(j, "version", ""); version != format_version)
      read.fail("The friction table has version " + read.member(j, "version", "").dump(), "version",
                std::to_string(format_version));

    FrictionTable table;
    read.unit(read.member(j, "sq", ""), "mm", "sq");
    table.sq = read.number(j.at("sq"), "value", "sq");
    read.unit(read.member(j, "initial_cut_height", ""), "mm", "initial_cut_height");
    table.initial_cut_height = read.number(j.at("initial_cut_height"), "value", "initial_cut_height");
    const json &curve_list   = read.member(j, "state_curves", "");
    visit_curves(table.curves, [&](const char *key, std::vector<double> &values, const char *unit) {
      const std::string place = std::string("state_curves/") + key;
      const json       &curve = read.member(curve_list, key, "state_curves");
      read.unit(curve, unit, place);
      values = read.numbers(curve, "values", place);
    });
    const json &table_list = read.member(j, "tables", "");
    visit_tables(table, [&](const char *key, auto &t, const auto &names, const char *unit, const char *) {
      const std::string place = std::string("tables/") + key;
      const json       &item  = read.member(table_list, key, "tables");
      read.unit(item, unit, place);
      t = table_from_json(item, names, place, read);
    });
    table.provenance = read.member(j, "provenance", "");
    table.check(name);
    return table;
  }

  FrictionTable
  FrictionTable::read(const std::filesystem::path &json_file)
  {
    const json j = json::parse(read_file(json_file), nullptr, false);
    if (j.is_discarded())
      Reader(json_file.string()).fail("The file is not valid JSON (truncated or altered?)", "");
    return from_json(j, json_file.string());
  }

  CsvTable
  FrictionTable::monotone_look_up() const
  {
    CsvTable     csv({ "p_solid_mpa", "eps_p", "cut_height_um", "contact_fraction", "h_avg_um", "tau_solid_mpa",
                       "mu_boundary", "phi_p_xx", "phi_p_yy", "phi_s_xx", "phi_s_yy" });
    const double um = 1e-3;
    for (const double p : cut_height_monotone.axes()[0].points)
      for (const double eps : cut_height_monotone.axes()[1].points)
        {
          const double s   = cut_height_monotone.value({ p, eps });
          const Film   f   = film(s);
          const double tau = f.contact_fraction > 0 ? solid_shear(s, p, p / f.contact_fraction, eps) : 0.;
          csv.add_row({ p, eps, s / um, f.contact_fraction, f.h_avg / um, tau, tau / p, f.phi_p(0, 0), f.phi_p(1, 1),
                        f.phi_s(0, 0), f.phi_s(1, 1) });
        }
    return csv;
  }

  void
  FrictionTable::write(const std::filesystem::path &json_file, const std::filesystem::path &csv_file) const
  {
    check(json_file.string());
    if (!csv_file.empty())
      monotone_look_up().save(csv_file);
    write_file(json_file, to_json().dump(1, ' ') + "\n");
  }
} // namespace tribodraw
