// A mat of 4 x 4: rows on pins 2 to 5, columns on A0 to A3, each column with 10 kOhm to ground.
void setup() {
  Serial.begin(115200);
  for (int row = 2; row < 6; row++) pinMode(row, OUTPUT);
}

void loop() {
  for (int row = 2; row < 6; row++) {
    digitalWrite(row, HIGH);
    for (int column = A0; column <= A3; column++) { Serial.print(analogRead(column)); Serial.print(' '); }
    digitalWrite(row, LOW);
  }
  Serial.println();
}
