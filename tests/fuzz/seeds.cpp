#include "seeds.hpp"

#include <algorithm>
#include <cstring>

namespace nearfield::test {
namespace {

/// The bytes of hexadecimal digits.
std::string bytes_of(const std::string& digits) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
        bytes.push_back(static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16)));
    }
    return bytes;
}

FuzzFormat geojson() {
    return {"f.geojson",
            {R"({"type":"Polygon","coordinates":[[[0,0],[4,0],[4,3]],[[1,1],[2,1],[2,2]]]})",
             R"({"type":"FeatureCollection","features":[{"type":"Feature","geometry":null},
                {"type":"Feature","geometry":{"type":"GeometryCollection","geometries":[
                {"type":"Point","coordinates":[1,2]},{"type":"MultiPolygon","coordinates":[
                [[[0,0],[4,0],[4,3]]],[],[[[5,5],[6,5],[6,6]]]]}]},"properties":{}}]})"},
            {"[", "]", "{", "}", ",", ":", "null", "[]", "{}", "\"type\"", "\"Polygon\"",
             "\"MultiPolygon\"", "\"LineString\"", "\"coordinates\"", "[1,2]", "1e5", "\\u0000"}};
}

FuzzFormat wkt() {
    return {"f.wkt",
            {"POLYGON Z((0 0 1,4 0 1,4 3 1),(1 1 0,2 1 0,2 2 0))",
             "SRID=4326;GEOMETRYCOLLECTION(MULTIPOLYGON(((0 0,4 0,4 4),EMPTY),EMPTY,((5 5,6 5,6 "
             "6))),POINT(1 1),LINESTRING EMPTY);"},
            {"POLYGON", "MULTIPOLYGON", "EMPTY", "GEOMETRYCOLLECTION(", "((", "))", ",", " ZM ",
             ";", "SRID=", "POINT", "MULTIPOINT((1 1),(2 2))", "1 1", "-"}};
}

const std::string polygon =
    "010300000001000000030000000000000000000000000000000000000000000000000010400000000000000000"
    "00000000000010400000000000000840";

FuzzFormat wkb() {
    const std::string collection =
        "0107000000"
        "02000000" +
        polygon + "0101000000000000000000F03F000000000000F03F";
    return {"f.wkb",
            {bytes_of(polygon),
             bytes_of("0106000000"
                      "01000000" +
                      polygon),
             bytes_of(collection)},
            {bytes_of("0103000000"), bytes_of("FFFFFFFF"), bytes_of("0107000000"),
             bytes_of("000000F07F000000"), bytes_of("EB030000"), bytes_of("03000020E6100000")}};
}

FuzzFormat hex_wkb() {
    return {"h.wkt",
            {polygon,
             "0106000000"
             "01000000" +
                 polygon},
            {"0103000000", "FFFFFFFF", "0107000000", "\n", "0000000003", "EB030000", "0x", "\\x"}};
}

FuzzFormat svg() {
    return {
        "f.svg",
        {R"svg(<svg viewBox="0 0 40 30" width="40mm" height="30mm"><style>.a, #b{fill-rule:evenodd}
path.c{display:none}</style><defs><g id="i"><path d="M0 0h4v3z M1 1a1 1 0 01.5.5z"/></g>
<symbol id="s" viewBox="0 0 4 4"><circle class="a" r="3"/></symbol></defs>
<use href="#i" transform="translate(1 2),rotate(30)"/><use xlink:href="#s" width="8" height="9"/>
<text>t</text></svg>)svg",
         R"svg(<?xml version="1.0"?><svg><g transform="matrix(1 0 0 -1 5 6)" style="fill-rule:nonzero">
<path id="b" d="m1 1c1 2 3 2 4 0s3-2 4 0q1 2 2 0t2 0z"/><polygon points="0,0 4,0 4,3"/></g>
<rect width="50" height="5" rx="1"/><svg x="1" viewBox="0 0 9 9" width="5" height="5">
<ellipse rx="2" ry="1" visibility="hidden"/><polyline points="1 1 2 2 3 1"/></svg></svg>)svg",
         R"svg(<!DOCTYPE svg [<!ENTITY a "fill-rule:evenodd"> <!ENTITY b '<n:rect width="1" height="2"/>'>
<!ENTITY c "&b;&b;">]><n:svg xmlns:n="http://www.w3.org/2000/svg"><n:path style="&a;" d="M0 0&#x20;h9v9z"/>
&c;<g xmlns="x"><path/></g><n:switch><n:g systemLanguage="de"/><n:g>&b;</n:g></n:switch></n:svg>)svg"},
        {"<g>",
         "</g>",
         "<use href='#i'/>",
         "<use href='#b'/>",
         "<path d='M0 0h1v1z'/>",
         "/>",
         "style='display:none'",
         "transform='scale(0)'",
         "/*",
         "*/",
         "{",
         "}",
         "@media a{",
         "<![CDATA[",
         "]]>",
         "<!--",
         "id='i'",
         "id='b'",
         "'",
         "\"",
         "%",
         "mm",
         "A1 1 0 1 1 2 2",
         "C1 1 2 2 3 3",
         "!important",
         "evenodd",
         "url(",
         "skewX(30)",
         "viewBox='0 0 1 1'",
         "&a;",
         "&b;",
         "&c;",
         "&#10;",
         "<!ENTITY a '&c;'>",
         "<!DOCTYPE s [",
         "]>",
         "xmlns='x'",
         "n:"}};
}

FuzzFormat path() {
    return {"f.path",
            {"M0 0h4v3z M1 1a1 1 0 01.5.5z", "m1 1c1 2 3 2 4 0s3-2 4 0q1 2 2 0t2 0zM5 5H9V9L3 3"},
            {"M", "z", "a1 1 0 11", "C", "1e5", "-.5", ",", "h", "T2 2", "S1 1 2 2"}};
}

FuzzFormat scene() {
    return {"f.json",
            {R"({"shapes":{"a":{"rings":[[[0,0],[2,0],[2,1]]],"fill_rule":"nonzero","offset":0.1}},
"instances":{"x":{"shape":"a","pose":[1,2,30]},"y":{"shape":"a","end_pose":[1,1,1]}},
"groups":{"g":["x","y"]},"queries":[{"query":"contacts","a":"x","b":"y","tolerance":0.1},
{"query":"penetration","pairs":{"between":["g","x"]},"tolerance":0.1,"hits_only":true},
{"query":"nearest","points":[[1,2]],"count":2,"against":"g"}]})"},
            {"[", "]", "{", "}", ",", "null", "\"pairs\":\"all\"", "\"shapes\"", "\"deviation\":1",
             "\"clean_width\":1", "\"offset\":0.5", "\"query\":\"poses\"", "[1,2,3]", "\"x\"",
             "true", "-1"}};
}

/// A word a line.
std::string lines(std::string words) {
    std::replace(words.begin(), words.end(), ' ', '\n');
    return words + "\n";
}

FuzzFormat dxf() {
    return {
        "f.dxf",
        {lines("0 SECTION 2 HEADER 9 $INSUNITS 70 4 0 ENDSEC 0 SECTION 2 BLOCKS 0 BLOCK 2 b 10 "
               "1 20 1 0 CIRCLE 10 0 20 0 40 .5 0 ENDBLK 0 ENDSEC 0 SECTION 2 ENTITIES 0 "
               "INSERT 2 b 10 5 20 5 41 2 50 30 0 LWPOLYLINE 70 1 10 0 20 0 42 1 10 4 20 0 10 "
               "4 20 3 0 TEXT 1 t 0 ENDSEC 0 EOF"),
         lines("0 SECTION 2 HEADER 9 $INSUNITS 70 1 0 ENDSEC 0 SECTION 2 ENTITIES 0 LINE 10 0 "
               "20 0 11 4 21 0 0 ARC 10 4 20 1 40 1 50 270 51 90 0 LINE 10 4 20 2 11 0 21 0 0 "
               "POLYLINE 70 1 0 VERTEX 10 5 20 5 42 -.3 0 VERTEX 10 7 20 5 0 VERTEX 10 7 20 7 "
               "0 SEQEND 0 ELLIPSE 10 0 20 9 11 1 21 0 40 .5 0 ENDSEC 0 EOF"),
         lines("0 SECTION 2 ENTITIES 0 SPLINE 70 8 71 2 40 0 40 0 40 0 40 1 40 1 40 1 10 0 20 0 "
               "30 0 10 1 20 2 30 0 10 2 20 0 30 0 0 ELLIPSE 10 1 20 0 11 1 21 0 40 .5 41 0 42 "
               "3.14159265358979 230 -1 0 ENDSEC 0 EOF")},
        {"0\n",
         "\n",
         lines("0 LINE"),
         lines("0 ARC"),
         lines("0 INSERT 2 b 10 0 20 0"),
         lines("0 ENDSEC"),
         lines("0 ENDBLK"),
         lines("0 BLOCK 2 b"),
         lines("0 VERTEX 10 1 20 1"),
         lines("230 -1"),
         lines("42 1"),
         lines("70 1"),
         "999\n",
         lines("0 SPLINE"),
         lines("70 3 71 2 44 5 45 6"),
         lines("42 1e-300"),
         "\x1A",
         "\r\n",
         "-",
         lines("0 CIRCLE 10 0 20 0 40 1")}};
}

FuzzFormat csv() {
    return {"f.csv",
            {"x,y,degrees\n1,2,30\n-0.5, 1e3 ,0\r\n\n4,5,-720.25\n", "1,2,3\n4,5,6\n7,8,9",
             "\xEF\xBB\xBF"
             "2.5,1,0\n4.5,1,0\n"},
            {",", "\n", "\r\n", "\n\n", ",,", "1", "-1.5e-3", " ", "\t", "x,y", "+1", "0x1p3", ";",
             "1,2,3", "\"1\""}};
}

/// A file of NumPy's format, of two rows of three numbers.
template <class Number>
std::string npy(const std::string& start, const std::string& type) {
    const std::string header =
        "{'descr': '" + type + "', 'fortran_order': False, 'shape': (2, 3), }\n";
    std::string file = start + std::string(1, static_cast<char>(header.size()));
    file.resize(start[6] == 1 ? 10 : 12);  // the other bytes of the length are 0
    file += header;
    for (const double value : {1.5, 2.0, -30.0, 0.0, 1e6, 0.25}) {
        const auto number = static_cast<Number>(value);
        char bytes[sizeof(Number)];
        std::memcpy(bytes, &number, sizeof(Number));
        file.append(bytes, sizeof(Number));
    }
    return file;
}

FuzzFormat npy() {
    const std::string name = "\x93NUMPY";
    return {
        "f.npy",
        {npy<double>(name + bytes_of("0100"), "<f8"), npy<float>(name + bytes_of("0100"), "<f4"),
         npy<double>(name + bytes_of("0200"), "<f8")},
        {"'descr':", "'shape':", "'fortran_order':", "(2, 3)", "(2,)", "()", "(0, 3)", "(", ")",
         "True", "'<f4'", "'<f8'", "'>f8'", "18446744073709551615", "4611686018427387904, ",
         bytes_of("000000000000F07F"), bytes_of("0000000000000000"), bytes_of("0000F03F"),
         bytes_of("FFFF")}};
}

}  // namespace

std::vector<FuzzFormat> fuzz_formats() {
    return {geojson(), wkt(), wkb(), hex_wkb(), svg(), path(), dxf(), scene(), csv(), npy()};
}

}  // namespace nearfield::test
