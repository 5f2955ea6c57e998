#include <tribodraw/base/errors.h>
#include <tribodraw/base/files.h>
#include <tribodraw/base/units.h>
#include <tribodraw/output/vtu.h>

#include <deal.II/base/data_out_base.h>

#include <algorithm>
#include <sstream>
#include <tuple>

namespace tribodraw
{
  namespace
  {
    using dealii::DataComponentInterpretation::component_is_part_of_vector;
    using VectorRange = std::tuple<unsigned int, unsigned int, std::string,
                                   dealii::DataComponentInterpretation::DataComponentInterpretation>;

    void
    check_length(const std::string &name, const std::size_t given, const std::size_t wanted, const char *what)
    {
      if (given != wanted)
        throw InputError(describe_error("A field to be written has the wrong length.", "field '" + name + "'",
                                        std::to_string(given) + " values",
                                        std::to_string(wanted) + " (one a " + what + ")"));
    }

    void
    check_lengths(const SurfaceFields &fields)
    {
      for (const auto &[name, values] : fields.node_scalars)
        check_length(name, values.size(), fields.points.size(), "node");
      for (const auto &[name, values] : fields.node_vectors)
        check_length(name, values.size(), fields.points.size(), "node");
      for (const auto &[name, values] : fields.cell_scalars)
        check_length(name, values.size(), fields.triangles.size(), "triangle");
      for (const auto &triangle : fields.triangles)
        for (const unsigned node : triangle)
          if (node >= fields.points.size())
            throw InputError(describe_error("A triangle to be written has a node that does not exist.", "",
                                            std::to_string(node), "0 to " + std::to_string(fields.points.size() - 1)));
    }

    dealii::DataOutBase::Patch<2, 3>
    make_patch(const SurfaceFields &fields, const unsigned index, const unsigned n_rows)
    {
      dealii::DataOutBase::Patch<2, 3> patch;
      patch.reference_cell = dealii::ReferenceCells::Triangle;
      patch.patch_index    = index;
      patch.n_subdivisions = 1;
      patch.data.reinit(n_rows, 3);
      for (unsigned corner = 0; corner < 3; ++corner)
        {
          const unsigned node = fields.triangles[index][corner];
          unsigned       row  = 0;
          for (int d = 0; d < 3; ++d)
            patch.vertices[corner][d] = fields.points[node][d];
          for (const auto &field : fields.node_vectors)
            for (int d = 0; d < 3; ++d)
              patch.data(row++, corner) = static_cast<float>(field.second[node][d]);
          for (const auto &field : fields.node_scalars)
            patch.data(row++, corner) = static_cast<float>(field.second[node]);
          for (const auto &field : fields.cell_scalars)
            patch.data(row++, corner) = static_cast<float>(field.second[index]);
        }
      return patch;
    }
  } // namespace

  void
  write_vtu(const std::filesystem::path &file, const SurfaceFields &fields)
  {
    check_lengths(fields);
    std::vector<std::string> names;
    std::vector<VectorRange> vectors;
    for (const auto &field : fields.node_vectors)
      {
        const unsigned first = static_cast<unsigned>(names.size());
        vectors.emplace_back(first, first + 2, field.first, component_is_part_of_vector);
        names.insert(names.end(), 3, field.first);
      }
    for (const auto &field : fields.node_scalars)
      names.push_back(field.first);
    for (const auto &field : fields.cell_scalars)
      names.push_back(field.first);

    std::vector<dealii::DataOutBase::Patch<2, 3>> patches;
    patches.reserve(fields.triangles.size());
    for (unsigned t = 0; t < fields.triangles.size(); ++t)
      patches.push_back(make_patch(fields, t, static_cast<unsigned>(names.size())));

#if DEAL_II_VERSION_GTE(9, 5, 0)
    using Compression = dealii::DataOutBase::CompressionLevel;
#else
    using Compression = dealii::DataOutBase::VtkFlags;
#endif
    dealii::DataOutBase::VtkFlags flags(fields.time, fields.cycle, /*print_date_and_time=*/false,
                                        Compression::best_compression,
                                        /*write_higher_order_cells=*/false, fields.units);
    std::ostringstream            out;
    dealii::DataOutBase::write_vtu(patches, names, vectors, flags, out);
    write_file(file, out.str());
  }

  void
  PvdCollection::add(const double time, const std::string &name)
  {
    entries.emplace_back(time, name);
  }

  // deal.II's write_pvd_record() puts the date into the file; ours must be the same bytes for the same run.
  void
  PvdCollection::save(const std::filesystem::path &file) const
  {
    std::string text
        = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
          "  <Collection>\n";
    for (const auto &[time, name] : entries)
      text += "    <DataSet timestep=\"" + units::number(time) + "\" group=\"\" part=\"0\" file=\"" + name + "\"/>\n";
    write_file(file, text + "  </Collection>\n</VTKFile>\n");
  }
} // namespace tribodraw
