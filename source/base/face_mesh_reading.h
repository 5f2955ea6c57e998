// What the readers of finite-element meshes share.
#ifndef tribodraw_source_base_face_mesh_reading_h
#define tribodraw_source_base_face_mesh_reading_h

#include <tribodraw/base/face_mesh.h>

#include <Eigen/Geometry>

#include <string_view>
#include <unordered_map>

namespace tribodraw::face_mesh
{
  /// Most elements of a file: a whole set of tools has some 500 000.
  constexpr std::size_t most_faces = 2000000;

  /// The lines of a file with their numbers.
  class Text
  {
  public:
    /// Throws InputError if the file cannot be read.
    explicit Text(const std::filesystem::path &file);

    /// Go to the next line; false at the end.
    bool next();
    /// The same; refuses the file if it ends here.
    void demand_next(const std::string &what);
    /// Let the present line be read again by next().
    void step_back();

    /// The line without the end of line.
    std::string_view
    line() const
    {
      return present;
    }
    std::size_t
    bytes() const
    {
      return content.size();
    }
    std::string place() const; ///< file and line

    const std::filesystem::path &
    path() const
    {
      return file;
    }

    /// Words between blanks.
    std::vector<std::string_view> words() const;

    double       real(std::string_view word) const;
    std::int64_t whole(std::string_view word) const;

    [[noreturn]] void refuse(const std::string &what, const std::string &value = "", const std::string &allowed = "",
                             const std::string &hint = "") const;

  private:
    std::filesystem::path file;
    std::string           content;
    std::string_view      present;
    std::size_t           begin = 0, end = 0, number = 0;
  };

  std::string_view              trimmed(std::string_view text);
  std::string                   upper(std::string_view text);
  std::vector<std::string_view> split(std::string_view text, char separator); ///< trimmed fields

  struct Face
  {
    static constexpr std::int64_t none = -1;

    std::int64_t                element = 0;
    std::array<std::int64_t, 4> corners{ none, none, none,
                                         none }; ///< numbers of nodes; the last is none for a triangle
    unsigned                    part = 0;
  };

  /// Nodes and faces with numbers of their own: a file, or a part of it.
  class Block
  {
  public:
    void add_node(const Text &text, std::int64_t number, const Eigen::Vector3d &x);
    void add_face(const Text &text, std::int64_t number, const std::array<std::int64_t, 4> &corners, unsigned part);

    /// Append the faces of which @p chosen to @p mesh, at the place @p position. Throws InputError for a corner that
    /// does not exist.
    template <class Chosen>
    void
    append_to(FaceMesh &mesh, const Eigen::Affine3d &position, const Chosen &chosen) const
    {
      std::vector<unsigned> image(nodes.size(), unused);
      for (const Face &face : faces)
        if (chosen(face))
          append(mesh, position, face, image);
    }

    std::vector<Face> faces;

  private:
    static constexpr unsigned unused = -1;

    void append(FaceMesh &mesh, const Eigen::Affine3d &position, const Face &face, std::vector<unsigned> &image) const;

    std::vector<Eigen::Vector3d>               nodes;
    std::unordered_map<std::int64_t, unsigned> index;
  };

  /// InputError: there is no such part.
  [[noreturn]] void refuse_part(const std::filesystem::path &file, const std::string &part,
                                const std::vector<std::string> &known);

  FaceMesh read_gmsh(const std::filesystem::path &file, const std::string &part);
  FaceMesh read_abaqus(const std::filesystem::path &file, const std::string &part);
  FaceMesh read_ls_dyna(const std::filesystem::path &file, const std::string &part);
} // namespace tribodraw::face_mesh

#endif
