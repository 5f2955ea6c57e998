#include <tribodraw/base/errors.h>
#include <tribodraw/base/own_process.h>
#include <tribodraw/output/measured_table.h>

#define H5_USE_110_API // later releases of the library keep these functions under this name
#include <hdf5.h>

#include <cstring>
#include <filesystem>
#include <regex>

namespace tribodraw::hdf5
{
  namespace
  {
    constexpr hsize_t largest_table = 20'000'000; // numbers

    /// Closes an HDF5 identifier.
    class Handle
    {
    public:
      Handle(const hid_t identifier, herr_t (*close_function)(hid_t)) : id(identifier), close(close_function) {}
      ~Handle()
      {
        if (id >= 0)
          close(id);
      }
      Handle(const Handle &)            = delete;
      Handle &operator=(const Handle &) = delete;
      operator hid_t() const { return id; }

    private:
      hid_t id;
      herr_t (*close)(hid_t);
    };

    bool
    is_number(const hid_t type)
    {
      const H5T_class_t c = H5Tget_class(type);
      return c == H5T_INTEGER || c == H5T_FLOAT;
    }

    /// Rows of a one-dimensional data set, or nothing usable: 0.
    hsize_t
    rows(const hid_t data)
    {
      const Handle space(H5Dget_space(data), H5Sclose);
      hsize_t      n = 0;
      return H5Sget_simple_extent_ndims(space) == 1 && H5Sget_simple_extent_dims(space, &n, nullptr) == 1 ? n : 0;
    }

    struct Reader
    {
      std::string file, wanted;

      [[noreturn]] void
      fail(const std::string &what, const std::string &hint = "") const
      {
        throw InputError(describe_error(what, file + (wanted.empty() ? "" : ":" + wanted), "", "", hint));
      }

      void
      read_column(MeasuredTable &table, const hid_t data, const hid_t memory_type, const std::string &name,
                  const hsize_t n) const
      {
        if (n > largest_table / (table.columns.size() + 1))
          fail("the table has " + std::to_string(table.columns.size() + 1) + " or more columns of " + std::to_string(n)
               + " rows, more than " + std::to_string(largest_table) + " numbers.");
        MeasuredTable::Column column{ name, std::vector<double>(n) };
        if (H5Dread(data, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, column.values.data()) < 0)
          fail("column '" + name + "' cannot be read.");
        table.columns.push_back(std::move(column));
      }

      MeasuredTable
      read_compound(const hid_t data) const
      {
        const hsize_t n = rows(data);
        const Handle  type(H5Dget_type(data), H5Tclose);
        MeasuredTable table;
        for (int m = 0; m < H5Tget_nmembers(type); ++m)
          {
            const Handle member(H5Tget_member_type(type, static_cast<unsigned>(m)), H5Tclose);
            if (!is_number(member))
              continue;
            char             *text = H5Tget_member_name(type, static_cast<unsigned>(m));
            const std::string name = text;
            H5free_memory(text);
            const Handle one(H5Tcreate(H5T_COMPOUND, sizeof(double)), H5Tclose);
            H5Tinsert(one, name.c_str(), 0, H5T_NATIVE_DOUBLE);
            read_column(table, data, one, name, n);
          }
        return table;
      }

      /// All members of a group that are columns.
      MeasuredTable
      read_group(const hid_t group) const
      {
        MeasuredTable table;
        H5G_info_t    info;
        if (H5Gget_info(group, &info) < 0)
          fail("the group cannot be read.");
        hsize_t length = 0;
        for (hsize_t k = 0; k < info.nlinks && k < 10000; ++k)
          {
            char          name[256];
            const ssize_t size
                = H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, name, sizeof name, H5P_DEFAULT);
            if (size < 0 || size >= static_cast<ssize_t>(sizeof name))
              continue;
            const Handle object(H5Oopen(group, name, H5P_DEFAULT), H5Oclose);
            if (object < 0 || H5Iget_type(object) != H5I_DATASET)
              continue;
            const Handle  type(H5Dget_type(object), H5Tclose);
            const hsize_t n = rows(object);
            if (!is_number(type) || n == 0)
              continue;
            if (table.columns.empty())
              length = n;
            else if (n != length)
              fail("data set '" + std::string(name) + "' has " + std::to_string(n) + " values, '"
                   + table.columns.front().name + "' has " + std::to_string(length) + ".");
            read_column(table, object, H5T_NATIVE_DOUBLE, name, n);
          }
        return table;
      }

      struct Found
      {
        std::vector<std::string> compounds, groups;
      };

      static herr_t
      look(const hid_t root, const char *name, const H5O_info_t *info, void *found_by_address)
      {
        auto &found = *static_cast<Found *>(found_by_address);
        if (info->type != H5O_TYPE_DATASET || found.compounds.size() + found.groups.size() > 1000)
          return 0;
        const Handle data(H5Dopen2(root, name, H5P_DEFAULT), H5Dclose);
        const Handle type(H5Dget_type(data), H5Tclose);
        if (rows(data) == 0)
          return 0;
        if (H5Tget_class(type) == H5T_COMPOUND)
          found.compounds.push_back(std::string("/") + name);
        else if (is_number(type))
          {
            const std::string path  = std::string("/") + name;
            const std::string group = path.substr(0, std::max<std::size_t>(1, path.rfind('/')));
            if (found.groups.empty() || found.groups.back() != group)
              found.groups.push_back(group);
          }
        return 0;
      }

      std::string
      only_table(const hid_t root) const
      {
        Found found;
        H5Ovisit(root, H5_INDEX_NAME, H5_ITER_INC, look, &found);
        const auto &tables = found.compounds.empty() ? found.groups : found.compounds;
        if (tables.empty())
          fail("the file holds no table: neither a one-dimensional compound data set nor a group of number columns.");
        if (tables.size() == 1)
          return tables.front();
        std::string all;
        for (std::size_t k = 0; k < tables.size() && k < 20; ++k)
          all += (k ? ", " : "") + tables[k];
        fail("the file holds " + std::to_string(tables.size()) + " tables.", "Name one: " + file + ":PATH, with PATH one of " + all + ".");
      }

      MeasuredTable
      read() const
      {
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); // our own messages only
        const Handle root(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
        if (root < 0)
          fail("this is not an HDF5 file, or a damaged one.");
        const std::string place = wanted.empty() ? only_table(root) : wanted;
        const Handle      object(H5Oopen(root, place.c_str(), H5P_DEFAULT), H5Oclose);
        if (object < 0)
          fail("there is no '" + place + "' in the file.");
        MeasuredTable table;
        if (H5Iget_type(object) == H5I_GROUP)
          table = read_group(object);
        else if (H5Iget_type(object) == H5I_DATASET && rows(object) > 0)
          table = read_compound(object);
        if (table.columns.empty())
          fail("there are no columns of numbers in '" + place + "'.");
        table.source = file + ":" + place;
        return table;
      }
    };

    /// The source, and name and values of each column, each after their number.
    std::string
    packed(const MeasuredTable &table)
    {
      std::string text;
      const auto  put = [&text](const void *data, const std::size_t n, const std::size_t size) {
        text.append(reinterpret_cast<const char *>(&n), sizeof n).append(static_cast<const char *>(data), n * size);
      };
      put(table.source.data(), table.source.size(), 1);
      for (const auto &column : table.columns)
        {
          put(column.name.data(), column.name.size(), 1);
          put(column.values.data(), column.values.size(), sizeof(double));
        }
      return text;
    }

    /// Not even this text is trusted: a library that ran over its memory has written it.
    MeasuredTable
    unpacked(const std::string &text, const std::string &failure)
    {
      std::size_t at   = 0;
      const auto  take = [&](void *target, const std::size_t size) {
        if (size > text.size() - at)
          throw InputError(failure);
        std::memcpy(target, text.data() + at, size);
        at += size;
      };
      const auto get = [&](auto &target) {
        std::size_t n = 0;
        take(&n, sizeof n);
        if (n > (text.size() - at) / sizeof target[0])
          throw InputError(failure);
        target.resize(n);
        take(target.data(), n * sizeof target[0]);
      };
      MeasuredTable table;
      get(table.source);
      while (at < text.size())
        {
          table.columns.emplace_back();
          get(table.columns.back().name);
          get(table.columns.back().values);
        }
      return table;
    }
  } // namespace

  bool
  is_hdf5_path(const std::string &path)
  {
    return std::regex_search(path, std::regex("\\.(h5|hdf5)(:|$)", std::regex::icase));
  }

  MeasuredTable
  read_table(const std::string &path)
  {
    const auto colon = path.rfind(':');
    const bool named = colon != std::string::npos && colon > path.rfind(".h");
    const Reader reader{ path.substr(0, named ? colon : path.size()), named ? path.substr(colon + 1) : "" };
    if (!std::filesystem::is_regular_file(reader.file))
      throw InputError(describe_error("the file does not exist.", reader.file));
    // The HDF5 library itself crashes on one of some 2000 damaged files: its checks are its own, and happen too late for us.
    const std::string failure = describe_error("the HDF5 library broke down while it read this file, which is damaged.", reader.file);
    return unpacked(in_own_process([&] { return packed(reader.read()); }, failure, {}), failure);
  }
} // namespace tribodraw::hdf5
