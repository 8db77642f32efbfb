within AntonWalk;
pure function wishedShares "Shares of stride and turn that an operator wishes"
  extends Modelica.Icons.Function;
  input Real speed(unit="1") "Walking speed over the greatest one";
  input Real turning(unit="1") "Turning rate over the greatest one";
  input Real deadZone(unit="1") "Share below which a wish counts as none";
  output Real wish[2](each unit="1") "Stride and turn, each from -1 to 1, together at most 1";
protected
  Real beyond[2](each unit="1") "What is beyond the dead zone, as a share of what can be";
algorithm
  beyond := {max(0, abs(speed) - deadZone)/(1 - deadZone),max(0, abs(turning) - deadZone)/(1 - deadZone)};
  wish := {(if speed < 0 then -beyond[1] else beyond[1]),(if turning < 0 then -beyond[2] else beyond[2])}/max(1, beyond[1] + beyond[2]);
  annotation (Inline=false);
end wishedShares;
