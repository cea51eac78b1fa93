// Prints what the library NMEA2000 (https://github.com/ttlappalainen/NMEA2000) reads in whole messages,
// one JSON object on a line, under the names of our structs; codes as numbers. For tests/conformance/n2k.py.
//
//     g++ -O1 -I NMEA2000/src tests/conformance/n2k_decode.cpp NMEA2000/src/N2kMsg.cpp \
//         NMEA2000/src/N2kMessages.cpp NMEA2000/src/N2kStream.cpp NMEA2000/src/N2kTimer.cpp -o n2k_decode
//
// Messages come on standard input as canboat writes them: time, priority, group, source, destination,
// length, bytes in hexadecimal, all with commas between. A group that the library cannot read has an
// empty object.

#include <cstdint>
#include <cstdio>
#include <iostream>
#include <sstream>
#include <string>

#include "N2kMessages.h"

// What the library wants of its platform; nothing here waits or logs.
extern "C" uint32_t millis() { return 0; }
extern "C" void delay(uint32_t) {}

static std::string line;

static void put(const char *name, const std::string &value) {
  line += (line.empty() ? "\"" : ",\"") + std::string(name) + "\":" + value;
}

static void number(const char *name, double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  put(name, N2kIsNA(value) ? "null" : text);
}

// A whole number, and the one that says "not available".
static void whole(const char *name, long long value, long long none) {
  put(name, value == none ? "null" : std::to_string(value));
}

static void attitudes(const tN2kMsg &m) {
  uint8_t sid;
  uint16_t date;
  double a, b, c;
  tN2kHeadingReference reference;
  tN2kMagneticVariation source;
  tN2kDelaySource delay_source;
  if (ParseN2kPGN127250(m, sid, a, b, c, reference)) {
    whole("sid", sid, 255);
    number("heading", a);
    number("deviation", b);
    number("variation", c);
    whole("reference", reference, 3);
  } else if (ParseN2kPGN127251(m, sid, a)) {
    whole("sid", sid, 255);
    number("rate", a);
  } else if (ParseN2kPGN127252(m, sid, a, b, delay_source)) {
    whole("sid", sid, 255);
    number("heave", a);
  } else if (ParseN2kPGN127257(m, sid, a, b, c)) {
    whole("sid", sid, 255);
    number("yaw", a);
    number("pitch", b);
    number("roll", c);
  } else if (ParseN2kPGN127258(m, sid, source, date, a)) {
    whole("sid", sid, 255);
    whole("source", source, 15);
    whole("date", date, 65535);
    number("variation", a);
  }
}

static void motions(const tN2kMsg &m) {
  uint8_t sid;
  uint16_t date;
  uint32_t log, trip;
  double a, b;
  tN2kSpeedWaterReferenceType kind;
  tN2kHeadingReference reference;
  if (ParseN2kPGN128259(m, sid, a, b, kind)) {
    whole("sid", sid, 255);
    number("water", a);
    number("ground", b);
    whole("kind", kind, 15);
  } else if (ParseN2kPGN128275(m, date, a, log, trip)) {
    whole("date", date, 65535);
    number("time", a);
    whole("log", log, N2kUInt32NA);
    whole("trip", trip, N2kUInt32NA);
  } else if (ParseN2kPGN129025(m, a, b)) {
    number("latitude", a);
    number("longitude", b);
  } else if (ParseN2kPGN129026(m, sid, reference, a, b)) {
    whole("sid", sid, 255);
    whole("reference", reference, 3);
    number("course", a);
    number("speed", b);
  }
}

static void times(const tN2kMsg &m) {
  uint8_t sid;
  uint16_t date;
  int16_t offset;
  double a;
  tN2kTimeSource source;
  if (ParseN2kPGN126992(m, sid, date, a, source)) {
    whole("sid", sid, 255);
    whole("source", source, 15);
    whole("date", date, 65535);
    number("time", a);
  } else if (ParseN2kPGN129033(m, date, a, offset)) {
    whole("date", date, 65535);
    number("time", a);
    whole("local_offset", offset, N2kInt16NA);
  }
}

static void fixes(const tN2kMsg &m) {
  uint8_t sid, satellites, stations;
  uint16_t date, id;
  double time, latitude, longitude, altitude, hdop, vdop, tdop, geoid, age;
  tN2kGNSStype system, station;
  tN2kGNSSmethod method;
  tN2kGNSSDOPmode desired, actual;
  if (ParseN2kPGN129029(m, sid, date, time, latitude, longitude, altitude, system, method, satellites,
                        hdop, vdop, geoid, stations, station, id, age)) {
    whole("sid", sid, 255);
    whole("date", date, 65535);
    number("time", time);
    number("latitude", latitude);
    number("longitude", longitude);
    number("altitude", altitude);
    whole("system", system, 15);
    whole("method", method, 15);
    whole("satellites", satellites, 255);
    number("hdop", hdop);
    number("pdop", vdop);
    number("geoid", geoid);
    if (stations != 255 && stations > 0) {
      // the library reads the first station only
      whole("first_system", station, 15);
      whole("first_id", id, 4095);
      number("first_age", age);
    }
  } else if (ParseN2kPgn129539(m, sid, desired, actual, hdop, vdop, tdop)) {
    whole("sid", sid, 255);
    whole("desired", desired, 7);
    whole("actual", actual, 7);
    number("hdop", hdop);
    number("vdop", vdop);
    number("tdop", tdop);
  }
}

int main() {
  std::string text;
  while (std::getline(std::cin, text)) {
    std::istringstream fields(text);
    std::string field;
    tN2kMsg message;
    for (int place = 0; std::getline(fields, field, ','); place++) {
      if (place == 2) message.SetPGN(std::stoul(field));
      if (place >= 6) message.AddByte(std::stoul(field, nullptr, 16));
    }
    line.clear();
    attitudes(message);
    motions(message);
    times(message);
    fixes(message);
    std::cout << "{" << line << "}\n";
  }
}
