// Radiance/LBNL BSDF XML: Klems matrices and tensor trees read as described, and broken ones refused.
#include "fit/formats/bsdf_xml.h"

#include "format_samples.h"

using namespace gonio;
using namespace gonio::test;

namespace {

/// A band of the zenith angle.
std::string band(double lower, double upper, double middle, int azimuths) {
  return fmt::format(
      "<AngleBasisBlock><Theta>{}</Theta><nPhis>{}</nPhis>\n<ThetaBounds><LowerTheta>{}</LowerTheta><UpperTheta>{}</"
      "UpperTheta>"
      "</ThetaBounds></AngleBasisBlock>\n",
      middle, azimuths, lower, upper);
}

std::string file_of(std::string_view structure, std::string_view basis, std::string_view block) {
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<WindowElement "
      "xmlns=\"http://windows.lbl.gov\">\n<Optical>\n<Layer>\n"
      "<Material><Name>a "
      "test's</Name></Material>\n<DataDefinition>\n<IncidentDataStructure>{}</IncidentDataStructure>\n{}</"
      "DataDefinition>\n"
      "<WavelengthData>\n<Wavelength unit=\"Integral\">Visible</Wavelength>\n<WavelengthDataBlock>\n"
      "<WavelengthDataDirection>Reflection "
      "Front</WavelengthDataDirection>\n{}</WavelengthDataBlock>\n</WavelengthData>\n</Layer>\n</Optical>\n"
      "</WindowElement>\n",
      structure, basis, block);
}

std::string matrix_file(std::string_view structure, std::string_view bands, std::string_view numbers) {
  return file_of(
      structure, fmt::format("<AngleBasis><AngleBasisName>B</AngleBasisName>\n{}</AngleBasis>\n", bands),
      fmt::format("<ColumnAngleBasis>B</ColumnAngleBasis>\n<RowAngleBasis>B</RowAngleBasis>\n<ScatteringDataType>BRDF"
                  "</ScatteringDataType>\n<ScatteringData>\n{}\n</ScatteringData>\n",
                  numbers));
}

std::string tree_file(int axes, std::string_view numbers) {
  return file_of(
      fmt::format("TensorTree{}", axes), "",
      fmt::format("<AngleBasis>LBNL/Shirley-Chiu</AngleBasis>\n<ScatteringDataType>BRDF</ScatteringDataType>\n"
                  "<ScatteringData>\n{}\n</ScatteringData>\n",
                  numbers));
}

/// The bands of "LBNL/Klems Full": 145 directions.
std::string klems_full() {
  const int azimuths[] = {1, 8, 16, 20, 24, 24, 24, 16, 12};
  std::string text = band(0, 5, 0, 1);
  for (int k = 1; k < 9; ++k) text += band(10 * k - 5, k == 8 ? 90 : 10 * k + 5, k == 8 ? 82.5 : 10 * k, azimuths[k]);
  return text;
}

const std::string kBands = band(0, 30, 0, 1) + band(30, 90, 60, 2);

std::string good_matrix() { return matrix_file("Columns", kBands, "1, 2, 3,\n4 5 6\n7 8 9"); }
std::string good_tree() { return tree_file(3, "{ {1}{2}{3}{4} {5}{6}{7}{ 8 9 10 11 12 13 14 15 } }"); }

}  // namespace

TEST_CASE("a Klems matrix: the diagonal is the mirror direction", "[fit][bsdf_xml]") {
  std::string numbers;
  for (int row = 0; row < 145; ++row) {
    for (int column = 0; column < 145; ++column) numbers += row == column ? "5 " : "0.25, ";
    numbers += '\n';
  }
  const Measurement scan = format_named("bsdf-xml").read(matrix_file("Columns", klems_full(), numbers), "FILE");
  REQUIRE(scan.points.size() == 145 * 145);
  CHECK(scan.name == "a test's");
  CHECK(scan.quantity == "brdf");
  CHECK(scan.incidences_deg == std::vector<double>{0, 10, 20, 30, 40, 50, 60, 70, 82.5});
  for (const ScanPoint& p : scan.points) {
    const bool mirror = p.theta_i_deg == p.theta_o_deg && std::abs(std::remainder(p.phi_deg() - 180, 360)) < 1e-9;
    CHECK(p.f_per_sr == (mirror ? 5 : 0.25));
  }
}

TEST_CASE("a Klems matrix by columns or rows of incidence", "[fit][bsdf_xml]") {
  const auto value = [](const char* structure) {
    const Measurement scan = read_bsdf_xml(matrix_file(structure, kBands, "1, 2, 3,\n4 5 6\n7 8 9"), "FILE");
    for (const ScanPoint& p : scan.points)
      if (p.theta_i_deg == 60 && p.theta_o_deg == 0 && p.phi_i_deg == 180) return p.f_per_sr;
    return -1.0;
  };
  CHECK(value("Columns") == 2);
  CHECK(value("Rows") == 4);
}

TEST_CASE("tensor trees: axes, order and the concentric map", "[fit][bsdf_xml]") {
  // Isotropic, one level of values: axis 0 slowest. ½(1 - sin θ_i) = ¼ in the half that is used.
  const Measurement three = read_bsdf_xml(tree_file(3, "{1 2 3 4 5 6 7 8}"), "FILE");
  REQUIRE(three.points.size() == 4);
  for (const ScanPoint& p : three.points) {
    CHECK(p.theta_i_deg == Approx(30));
    CHECK(p.phi_i_deg == 180);
    CHECK(p.theta_o_deg == Approx(30));
  }
  CHECK(three.points[0].phi_o_deg == Approx(225));  // u = v = ¼
  CHECK(three.points[1].phi_o_deg == Approx(135));  // the last axis is fastest: v = ¾
  CHECK(three.points[2].phi_o_deg == Approx(315));
  CHECK(three.points[3].f_per_sr == 4);
  // Branches: bit 0 is axis 0, so the second branch is the half that is not used.
  const Measurement branches = read_bsdf_xml(good_tree(), "FILE");
  REQUIRE(branches.points.size() == 4);
  CHECK(branches.points[1].f_per_sr == 3);
  CHECK(branches.points[1].phi_o_deg == Approx(315));
  const Measurement four = read_bsdf_xml(tree_file(4, "{1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16}"), "FILE");
  REQUIRE(four.points.size() == 16);
  CHECK(four.points[0].phi_i_deg == Approx(45));  // travels towards 225°, so the light is at 45°
  CHECK(four.points[0].phi_o_deg == Approx(225));
  const Measurement even = read_bsdf_xml(tree_file(3, "{ 0.318309886 }"), "FILE");
  REQUIRE(even.points.size() == 1);
  CHECK(even.points[0].f_per_sr == 0.318309886);
  std::string all;
  for (const std::string& convention : even.conventions) all += convention + "\n";
  for (const char* word : {"BRDF without cosine", "absolute", "degrees", "x axis", "Reflection Front"})
    CHECK(all.find(word) != all.npos);
}

TEST_CASE("XML cut short is refused wherever it ends", "[fit][bsdf_xml][malformed]") {
  for (const std::string& text : {good_matrix(), good_tree()}) {
    REQUIRE(refusal("bsdf-xml", text) == "accepted");
    for (std::size_t end = 0; end + 2 < text.size(); ++end) check_refusal("bsdf-xml", text.substr(0, end), "FILE:");
  }
}

TEST_CASE("broken BSDF files are refused at their line", "[fit][bsdf_xml][malformed]") {
  struct Change {
    const char *from, *to, *words;
  };
  for (const Change& c : {Change{"<WindowElement", "<Window", "well-formed"},
                          {"</WindowElement>", "</Optical>", "well-formed"},
                          {"<Optical>", "<Optic>", "well-formed"},
                          {"Visible", "Visible<br/>", "plain text"},
                          {"Visible", "Solar", "no visible reflection"},
                          {"Visible", "", "plain text"},
                          {"Reflection Front", "Transmission Front", "no visible reflection"},
                          {"Columns", "Diagonals", "IncidentDataStructure"},
                          {"Columns", "TensorTree3", "AngleBasis"},
                          {"<AngleBasisName>B<", "<AngleBasisName>C<", "is named `B`"},
                          {"<ColumnAngleBasis>B<", "<ColumnAngleBasis>C<", "is named `C`"},
                          {"<RowAngleBasis>B</RowAngleBasis>", "", "no <RowAngleBasis>"},
                          {"BRDF", "BTDF", "ScatteringDataType"},
                          {"<ScatteringDataType>BRDF</ScatteringDataType>", "", "no <ScatteringDataType>"},
                          {"<LowerTheta>0<", "<LowerTheta>1<", "a band"},
                          {"<LowerTheta>30<", "<LowerTheta>31<", "a band"},
                          {"<UpperTheta>90<", "<UpperTheta>95<", "a band"},
                          {"<UpperTheta>90<", "<UpperTheta>20<", "a band"},
                          {"<UpperTheta>90<", "<UpperTheta>nan<", "finite"},
                          {"<Theta>60<", "<Theta>20<", "a band"},
                          {"<Theta>60<", "<Theta>sixty<", "finite"},
                          {"<Theta>60</Theta>", "", "no <Theta>"},
                          {"<nPhis>2<", "<nPhis>0<", "nPhis"},
                          {"<nPhis>2<", "<nPhis>2.5<", "nPhis"},
                          {"<nPhis>2<", "<nPhis>-3<", "nPhis"},
                          {"<nPhis>2<", "<nPhis>1000000000<", "nPhis"},
                          {"<nPhis>2<", "<nPhis>10000<", "too short"},
                          {"<nPhis>2<", "<nPhis>3<", "ends here"},
                          {"<nPhis>2<", "<nPhis>1<", "after the data"},
                          {"7 8 9", "7 8", "ends here"},
                          {"7 8 9", "7 8 9 10", "after the data"},
                          {"7 8 9", "7 8 nan", "no number"},
                          {"7 8 9", "7 8 inf", "no number"},
                          {"7 8 9", "7 8 1e999", "no number"},
                          {"7 8 9", "7 8 9x", "no number"},
                          {"7 8 9", "7 8 {9}", "no number"},
                          {"7 8 9", "7 8 <b>9</b>", "plain text"},
                          {"\n1, 2", "\n<!-- -->", "expected"}}) {
    INFO(c.from << " -> " << c.to);
    check_refusal("bsdf-xml", with(good_matrix(), c.from, c.to), "FILE:", c.words);
  }
  CHECK(refusal("bsdf-xml", with(good_matrix(), "5 6", "5 oops")).starts_with("FILE:24:"));
  for (const Change& c : {Change{"{ {1}", "{1}", "after the data"},
                          {"{ {1}", "{ {1", "is no number"},
                          {"{ {1}", "{ {1 2}", "a power of 8"},
                          {"{ {1}", "{ {}", "0 values"},
                          {"{ {1}", "{ 1", "no number"},
                          {"{ {1}", "{ {1}{1}", "`{ 8 9 10 1`"},
                          {"{ {1}", "[ {1}", "expected {"},
                          {"{ {1}", "{ {x}", "no number"},
                          {"14 15 }", "14 }", "a power of 8"},
                          {"14 15 }", "14 15 16 }", "a power of 8"},
                          {"14 15 } }", "14 15 }", "expected }"},
                          {"14 15 } }", "14 15 } } }", "after the data"},
                          {"TensorTree3", "TensorTree4", "a power of 16"},
                          {"TensorTree3", "TensorTree5", "IncidentDataStructure"},
                          {"LBNL/Shirley-Chiu", "LBNL/Klems Full", "Shirley-Chiu"}}) {
    INFO(c.from << " -> " << c.to);
    check_refusal("bsdf-xml", with(good_tree(), c.from, c.to), "FILE:", c.words);
  }
  check_refusal("bsdf-xml", tree_file(3, std::string(100000, '{')), "FILE:", "deeper than");
  check_refusal("bsdf-xml", tree_file(4, "{}"), "FILE:", "0 values");
  check_refusal("bsdf-xml", "", "FILE:1:");
  check_refusal("bsdf-xml", "<WindowElement/>", "FILE:1:", "no <Optical>");
  check_refusal("bsdf-xml", "<a/>", "FILE:1:", "WindowElement");
  const std::string block =
      "<WavelengthDataBlock><WavelengthDataDirection>Reflection Front</WavelengthDataDirection></WavelengthDataBlock>";
  check_refusal("bsdf-xml", with(good_matrix(), "</WavelengthData>", block + "</WavelengthData>"), "FILE:", "twice");
}
